"""The tests mirror the tree, file by file: ial/lidar/run.py is tested by tests/lidar/test_run.py. What is not so stands here."""

from pathlib import PurePosixPath

from tests.test_house import ROOT, kept_files

ACROSS = {  # tests of no single file, and what they are of
    "active/test_views.py": "the planner of two stages, beside an exhaustive search over views",
    "bouncing/test_margins.py": "what is rounded about walls and headings, from the polygon to the set",
    "cli/active/test_page.py": "the page on where to drive: its commands, its examples, and what it says of its pictures",
    "cli/compass/test_page.py": "the page about the compass robot, command by command",
    "cli/odometer/test_page.py": "the page about the odometer robot, command by command",
    "cli/test_bad_input.py": "everything that a user can do wrong in the main job",
    "cli/bounce/test_pages.py": "the pages about the bouncing robot, command by command",
    "contractors/test_guard.py": "the rounding mode, at every public name",
    "datasets/test_laziness.py": "what importing the package costs",
    "datasets/test_messages.py": "every message of the odometry counts, from the file to the answer",
    "datasets/test_sample.py": "the embedded recording",
    "lidar/configuration/test_documented.py": "what the pages say about keys",
    "lidar/test_as_problem.py": "the localizer beside a general problem of constraints",
    "lidar/test_auto_outliers.py": "the number of outliers that is chosen, beside runs with that number given",
    "lidar/test_fuzz_poses.py": "no consistent pose is lost, whatever the robot undergoes",
    "lidar/test_lidars.py": "several lidars on one robot",
    "lidar/test_printed_outliers.py": "the number of bad beams that is printed is the one that was used",
    "lidar/test_scenes.py": "known scenes, from the recording to the estimate",
    "lidar/test_symmetry.py": "maps that look the same after a rotation",
    "lidar/test_turns.py": "intervals of headings of any turn, at every entry",
    "membership/test_robots.py": "every robot through the one filter",
    "maps/test_package.py": "what importing the package costs",
    "study/test_independence.py": "measures share no code with what they measure",
    "test_benches.py": "what the benches import and edit",
    "test_examples.py": "examples in docstrings",
    "test_house.py": "the rules of the house",
    "test_mirror.py": "this one",
    "test_packaging.py": "what is installed",
    "test_pages.py": "the pages of the documentation",
    "test_readme.py": "types of the snippets of the README, and of a robot of one's own",
    "test_repr.py": "what every public object says of itself",
    "test_tutorial.py": "examples in pages",
}

UNMIRRORED = {  # files without a test of their own, by the reason, and the test that they have; a file that gets its own leaves this list
    "a step inside one other file which nothing else calls: judged by that file's twin or oracle": {
        "active/test_exploration.py": [
            "decision",
            "knowledge",
            "planners/entropy",
            "planners/nearest_frontier",
            "planners/random_walk",
            "planners/two_stage",
        ],
        "bouncing/automata/test_determinization.py": ["subset"],
        "bouncing/cells/test_noisy_map.py": ["cell_ways"],
        "bouncing/exports/test_archive.py": ["../filters/state_places"],
        "bouncing/filters/test_robust_building.py": ["robust_filter"],
        "bouncing/planning/test_angle_search.py": ["information_sets"],
        "compass/test_point_phase.py": ["chase", "gathering"],
        "contractors/expressions/test_functions.py": ["whole_exponent"],
        "contractors/expressions/test_tape.py": ["machine"],
        "contractors/test_boxes.py": ["elementwise"],
        "datasets/test_conversion.py": ["copied_messages"],
        "results/lidar/test_picture.py": ["panels"],
    },
    "kernels and tables of the search, which are right or wrong only together with the kernel that calls them": {
        "lidar/search/test_cell_counts.py": ["bitmap_counts", "empty_rectangles", "rectangle_indices"],
        "lidar/search/test_free_space.py": ["../evidence/rays"],
        "lidar/search/test_lattice.py": ["cell_bitmaps"],
        "lidar/search/test_scan_contractor.py": ["flat_table", "narrowing"],
        "lidar/test_auto_outliers.py": ["search/outlier_budget"],
        "lidar/test_turns.py": ["search/pose_contractor"],
    },
    "kernels and tables of the odometer robot, which are right or wrong only together": {
        "odometer/test_model.py": ["advancing", "casting", "command", "configurations", "odometer_bounds", "wall_table"],
        "odometer/test_triples.py": ["certificate", "chords"],
        "odometer/test_localization.py": ["estimate", "hypotheses", "opening_moves", "splitting"],
        "cli/odometer/test_run.py": ["drive", "../../odometer/example"],
    },
    "a part that several files share, seen in what each of them does with it": {
        "bouncing/cells/test_groups.py": ["graph"],
        "bouncing/test_bump_log.py": ["bump_event"],
        "bouncing/cells/test_noisy_map.py": ["../execution_bounds"],
        "bouncing/exports/test_c_source.py": ["exported_filter"],
        "bouncing/filters/test_bounce_filter.py": ["cycle_places", "setting"],
        "bouncing/rays/test_ray_model.py": ["ray_set"],
        "cli/compass/test_plan.py": ["surroundings"],
        "contractors/combinators/test_combination.py": ["rows"],
        "contractors/expressions/test_constraint.py": ["../combinators/family"],
        "contractors/expressions/test_expression.py": ["variables"],
        "datasets/test_carmen.py": ["carmen_line"],
        "datasets/test_conversion.py": ["bag_writer"],
        "datasets/test_recording.py": ["mark"],
        "datasets/test_ros.py": ["order", "reader", "ros_messages"],
        "datasets/test_survey.py": ["info"],
        "keys/test_record.py": ["key"],
        "lidar/evidence/test_end_points.py": ["evidence"],
        "lidar/test_atlas.py": ["pose_sets"],
        "lidar/test_checkpoint.py": ["output_end"],
        "maps/grids/test_cell_index.py": ["cell_table"],
        "maps/grids/test_map_file.py": ["map_warning"],
        "maps/polygons/test_polygon.py": ["ring"],
        "results/active/test_decisions.py": ["leg"],
        "results/lidar/test_picture.py": ["../palette"],
        "results/lidar/test_result_folder.py": ["sink"],
    },
    "one test for all: every robot, model and combination of worlds beside one brute-force twin": {
        "membership/test_robots.py": ["lapses", "model", "worlds"],
    },
    "two ends of one conversion, tested there and back": {
        "bouncing/exports/test_jflap.py": ["automata_lib", "finite_automaton"],
    },
    "what a picture is drawn on, seen in the pixels of the picture": {
        "results/active/test_path_picture.py": ["scene"],
        "results/bouncing/test_cycle_picture.py": ["ground", "page"],
        "study/test_failures.py": ["../results/lidar/failure_picture"],
    },
    "commands and what they print, tried as a user runs them": {
        "cli/active/test_explore.py": ["job", "options", "planning", "report", "simulated", "surroundings"],
        "cli/bounce/test_advise.py": ["advice_report"],
        "cli/bounce/test_build.py": ["options", "report"],
        "cli/bounce/test_log_run.py": ["log_outcome"],
        "cli/bounce/test_piece_build.py": ["piece_report"],
        "cli/bounce/test_run.py": ["observed", "outcome"],
        "cli/lidar/test_answer_file.py": ["streaming"],
        "cli/lidar/test_bounds.py": ["bounds_report"],
        "cli/lidar/test_localize.py": ["../../results/lidar/run_results"],
        "cli/lidar/test_warm.py": ["../../lidar/warming"],
        "cli/lidar/test_where.py": ["where_report"],
        "cli/shell/test_outputs.py": ["../lidar/job", "out_folder"],
        "cli/test_main.py": ["entry", "shell/inputs", "shell/options", "shell/terminal"],
    },
    "run once, by hand; what it made is tested": {
        "datasets/test_sample.py": ["sample/make_sample"],
    },
}


def resolved(folder: PurePosixPath, name: str) -> PurePosixPath:
    """Return the file of that name, seen from a folder."""
    while name.startswith("../"):
        folder, name = folder.parent, name.removeprefix("../")
    return folder / f"{name}.py"


FILES = [PurePosixPath(file.relative_to(ROOT).as_posix()) for file in kept_files() if file.suffix == ".py"]
TESTS = {file.relative_to("tests") for file in FILES if file.parts[0] == "tests" and file.name.startswith("test_")}
SOURCES = {
    file.relative_to("ial") if file.parts[0] == "ial" else file
    for file in FILES
    if file.parts[0] in {"ial", "contractors", "maps", "datasets"} and file.name != "__init__.py"
}
MIRRORED = {test.with_name(test.name.removeprefix("test_")) for test in TESTS}


def test_a_test_mirrors_a_file_or_says_what_it_is_of() -> None:
    of_none = {str(test) for test in TESTS if test.with_name(test.name.removeprefix("test_")) not in SOURCES}
    assert of_none - ACROSS.keys() == set(), "name a test after the file that it tests; if it is of several, say in ACROSS what it is of"
    assert ACROSS.keys() - of_none == set(), "these are gone, or mirror a file: take them out of ACROSS"


def test_a_file_has_its_test_or_is_on_the_list() -> None:
    listed = [
        str(resolved(PurePosixPath(test).parent, name)) for tests in UNMIRRORED.values() for test, names in tests.items() for name in names
    ]
    untested = {str(source) for source in SOURCES - MIRRORED}
    assert untested - set(listed) == set(), (
        "write a test of the same name for these files, or say in UNMIRRORED why not, and which test they have"
    )
    assert set(listed) - untested == set(), "these are gone, or have a test of their own: take them out of UNMIRRORED"
    assert len(listed) == len(set(listed))
    assert {test for tests in UNMIRRORED.values() for test in tests if PurePosixPath(test) not in TESTS} == set()
