"""`ial explore`: a simulated robot that does not know where it is drives until it does."""

from pathlib import Path
from typing import Annotated

import typer

from ial.cli.active import options as given
from ial.cli.shell.options import ConfigPath, Json, MapTopic, Overwrite, Semantics
from ial.cli.shell.out_folder import point_latest, stamped_folder, tell_replaced
from ial.cli.shell.outputs import check_folder, check_outputs
from ial.cli.shell.terminal import progress, say, say_json, shown
from ial.errors import ConfigError

NEVER_LOCALIZED = 3


def explore(
    map_choice: given.MapChoice = None,
    start: given.Start = None,
    planner: given.Planning = "direction",
    out: Annotated[Path | None, typer.Option(metavar="DIR", help="Where to write; out/explore-<map>-<time> if it is left out.")] = None,
    seed: given.Seed = 0,
    drives: given.Drives = 200,
    animate: given.Animation = None,
    compare: given.Compare = False,
    starts: given.Starts = None,
    world: given.WorldChoice = None,
    radius: given.Radius = 0.2,
    clearance: given.Clearance = None,
    range_m: given.Range = 4.0,
    beams: given.Beams = 90,
    fov: given.FieldOfView = 360.0,
    range_error_m: given.RangeError = 0.02,
    bearing_error_rad: given.BearingError = 0.002,
    bad_beams: given.BadBeams = 0,
    adversarial: given.Adversarial = False,
    alpha: given.Alpha = None,
    beta: given.Beta = None,
    raw: given.Raw = False,
    guaranteed: given.Guaranteed = False,
    config: ConfigPath = None,
    outliers: given.Outliers = None,
    settings: given.Settings = None,
    semantics: Semantics = "nav2",
    map_topic: MapTopic = None,
    overwrite: Overwrite = False,
    as_json: Json = False,
) -> None:
    """Drive a simulated lidar robot that knows its map, but not its place, until its place is known.

    As far as the map is right, no drive brings it nearer to anything than its radius, wherever it may still be. Errors of its odometry are
    as large as the configuration says; if it says nothing, smaller than those that `ial localize` allows.
    Writes what `ial localize` writes, and decisions.jsonl, tree.png and truth.tum. With --compare, writes comparison.csv instead.
    """
    from ial.active.safe_way import Distances
    from ial.cli.active.comparison import FILES as COMPARED
    from ial.cli.active.comparison import Comparison, table
    from ial.cli.active.job import FILES, ExplorationJob
    from ial.cli.active.planning import Planning
    from ial.cli.active.report import report
    from ial.cli.active.simulated import Simulated
    from ial.cli.active.surroundings import Surroundings
    from ial.cli.lidar.config_file import resolve
    from ial.results.active.film import check_film_name

    if starts is not None and not compare:
        raise ConfigError("--starts needs --compare; a single run starts at --start, or where --seed says")
    if compare:
        alone = {"--start": start, "--animate": animate, "--alpha": alpha, "--beta": beta, "--raw": raw, "--guaranteed": guaranteed}
        foreign = [option for option, said in alone.items() if said not in (None, False)]
        if foreign or planner != "direction":
            raise ConfigError(
                f"{', '.join(foreign or ['--planner'])}: not with --compare, which runs every planner from starts that are drawn"
            )
    if map_choice is None:
        map_choice, start = given.EMBEDDED_MAP, start or given.EMBEDDED_START
    surroundings = Surroundings(map_choice, world, semantics, map_topic)
    simulated = Simulated(radius, range_m, beams, fov, range_error_m, bearing_error_rad, bad_beams, adversarial)
    if clearance is not None:
        Distances(radius, clearance)
        if any(each.replace(" ", "").startswith("robot_radius_m=") for each in settings or ()):
            raise ConfigError("--clearance and --set robot_radius_m say the same; give one of them")
    beneath = {"robot_radius_m": radius + given.SPARE_M, **simulated.bounds(same_world=world is None)}
    resolved = resolve(config, settings or (), beneath=beneath, outliers=outliers, robot_radius_m=clearance)
    folder = out or stamped_folder(f"{'compare' if compare else 'explore'}-{surroundings.name}")
    if compare:
        replaces = check_folder(folder, COMPARED, [*surroundings.paths, config], overwrite)
        rows = Comparison(surroundings, simulated, resolved, given.STARTS if starts is None else starts, seed, drives, folder).run(
            lambda runs, count: progress(runs, count, surroundings.name)
        )
        if replaces:
            tell_replaced(folder)
        if out is None:
            point_latest(folder)
        if as_json:
            say_json(rows)
        else:
            for line in table(rows["runs"]):
                say(line)
            say(f"results in {shown(folder)}")
        return
    if animate is not None:
        check_film_name(animate)
    job = ExplorationJob(
        surroundings, simulated, Planning(planner, alpha, beta, raw, guaranteed, seed), resolved, folder, start, seed, drives, animate
    )
    read = [*surroundings.paths, config]
    if animate is not None:
        check_outputs([animate], read, overwrite)
    replaces = check_folder(folder, FILES, read, overwrite)
    last, record = job.run(lambda line: None if as_json else say(line))
    if replaces:
        tell_replaced(folder)
    if out is None:
        point_latest(folder)
    if as_json:
        say_json(record)
    else:
        for line in report(last, record):
            say(line)
        say(f"results in {shown(folder)}" + ("" if animate is None else f", the film in {shown(animate)}"))
    if record["exploration"]["ended_by"] not in ("localized", "symmetric"):
        raise typer.Exit(NEVER_LOCALIZED)
