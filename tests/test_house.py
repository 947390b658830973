"""The rules of the house, read off the source: who may import whom, how files are named, and what no file may hold."""

import ast
import re
import runpy
import subprocess
from collections.abc import Iterator
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent

HOUSE = runpy.run_path(str(ROOT / "docs" / "house.py"))
ROOMS = HOUSE["rooms"](HOUSE["PAGE"].read_text(encoding="utf-8"))  # the table of floors of docs/developing/architecture.md
UPWARD = {  # the only imports that close a circle, and so stand inside a function
    ("ial.contractors.contractor", "ial.contractors.combinators.combination"): "the operators & and |",
}
NUMBERED = {  # files that hold numbers as small as a margin, and are none that widens a bound
    "contractors/rounding.py": "asks the processor how it rounds",
    "contractors/solving/zeros.py": "the width of a first guess, which is then proved or not",
    "datasets/simulator.py": "how far simulated errors keep off their bounds",
    "datasets/survey.py": "seconds in a nanosecond",
    "ial/active/direction_choice.py": "how close two scores are that count as the same",
    "ial/active/planners/entropy.py": "how close two entropies are that count as the same",
    "ial/compass/chase.py": "tilts that are tried, and how far apart places are that a search tells apart",
    "ial/lidar/latencies.py": "the shortest time that is counted, and how finely",
    "ial/odometer/certificate.py": "the width of a first guess, which is then proved or not",
    "ial/odometer/chords.py": "how short a way is of which the direction is not looked at",
    "ial/odometer/hypotheses.py": "how near to its image a hypothesis is that counts as the same up to symmetry",
    "ial/odometer/model.py": "how fine boxes become, and how far corners of a symmetric polygon may miss each other",
    "ial/odometer/odometer_bounds.py": "the error of odometers that count as exact",
    "ial/odometer/pilot.py": "by how much readings differ that are expected to tell hypotheses apart",
    "ial/odometer/robot.py": "how far simulated errors keep off their bounds",
    "ial/odometer/splitting.py": "what a simulated ray is said to touch",
    "ial/odometer/triples.py": "how narrow boxes are of which doubles may first say what they see",
    "maps/grids/occupancy_grid.py": "the smallest width of a cell that is believed",
    "maps/grids/ray_casting.py": "what a simulated ray is said to touch",
}
VAGUE = {"utils", "util", "helpers", "helper", "common", "core", "misc"}


def kept_files() -> list[Path]:
    """Every file that git tracks or would track, but no link."""
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=ROOT, capture_output=True, text=True, check=True)
    files = [ROOT / name for name in listed.stdout.split("\0") if name]
    return [file for file in files if file.is_file() and not file.is_symlink()]


def modules() -> dict[str, Path]:
    """The modules of ial by their dotted names."""
    files = {}
    for file in kept_files():
        parts = file.relative_to(ROOT).with_suffix("").parts
        if file.suffix == ".py" and parts[0] in {"ial", "contractors", "maps", "datasets"}:
            parts = parts if parts[0] == "ial" else ("ial", *parts)
            files[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = file
    return files


MODULES = modules()


@cache
def parsed(module: str) -> ast.Module:
    return ast.parse(MODULES[module].read_text())


@cache
def imports(module: str) -> frozenset[str]:
    """Return the modules of ial that a module imports, anywhere in its text, also inside functions and for type checkers only."""
    return frozenset(imported(parsed(module)))


def imported(tree: ast.AST) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name.split(".")[0] == "ial")
        elif isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "ial":
            for alias in node.names:
                deeper = f"{node.module}.{alias.name}"
                yield deeper if deeper in MODULES else str(node.module)


def hidden_imports(tree: ast.AST) -> list[str]:
    """Return the calls of a tree that import a module by its name, unless the name says at once that it is none of ial's."""
    calls = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and ast.unparse(node.func).rpartition(".")[2] in {"import_module", "__import__", "resolve_name"}:
            name = node.args[0] if node.args else None
            first = name.values[0] if isinstance(name, ast.JoinedStr) else name
            known = first.value if isinstance(first, ast.Constant) else ""
            if not re.match(r"(?!ial\b)\w", str(known)):
                calls.append(ast.unparse(node))
    return calls


def room(module: str) -> str:
    return module.split(".")[1]


def may_import(importer: str, imported: str) -> bool:
    return importer == imported or ROOMS[imported].floor < ROOMS[importer].floor or imported in ROOMS[importer].siblings


def test_every_room_stands_in_the_table_and_no_other() -> None:
    assert {name for name, each in ROOMS.items() if not each.planned} == {room(module) for module in MODULES if module != "ial"}
    assert [name for name, each in ROOMS.items() if each.planned and each.path.exists()] == []


def test_the_picture_shows_the_imports() -> None:
    standing = {name: each for name, each in ROOMS.items() if not each.planned}
    arrows = {(room(module), room(target)) for module in MODULES if module != "ial" for target in imports(module) if target != "ial"}
    assert {(name, other) for name, others in HOUSE["arrows"](standing).items() for other in others} == {
        (name, other) for name, other in arrows if name != other
    }


@pytest.mark.parametrize(
    ("importer", "imported", "allowed"),
    [
        ("lidar", "contractors", True),
        ("contractors", "pose", False),
        ("maps", "datasets", False),
        ("maps", "lidar", False),
        ("particles", "lidar", True),
        ("particles", "bouncing", True),
        ("lidar", "particles", False),
        ("bouncing", "membership", True),
        ("bouncing", "lidar", False),
        ("results", "study", False),
        ("cli", "results", True),
    ],
)
def test_floors_are_read_as_the_house_says(importer: str, imported: str, allowed: bool) -> None:
    assert may_import(importer, imported) is allowed


def test_a_room_imports_only_from_beneath() -> None:
    arrows = [(module, target) for module in sorted(MODULES.keys() - {"ial"}) for target in sorted(imports(module) - {"ial"})]
    assert len(arrows) > len(MODULES)
    assert [(module, target) for module, target in arrows if not may_import(room(module), room(target))] == []


def graph() -> dict[str, set[str]]:
    """Who imports whom."""
    return {name: set(imports(name) - {"ial", name}) for name in MODULES.keys() - {"ial"}}


def test_no_circles() -> None:
    known = graph()
    for importer, target in UPWARD:
        known[importer].remove(target)
    TopologicalSorter(known).prepare()


@pytest.mark.parametrize(("importer", "target"), UPWARD)
def test_an_import_that_closes_a_circle_stands_inside_a_function(importer: str, target: str) -> None:
    known = graph()
    for other in UPWARD.keys() - {(importer, target)}:
        known[other[0]].remove(other[1])
    with pytest.raises(CycleError):
        TopologicalSorter(known).prepare()
    tree = parsed(importer)
    inside = {id(node) for function in ast.walk(tree) if isinstance(function, ast.FunctionDef) for node in ast.walk(function)}
    closing = [node for node in ast.walk(tree) if isinstance(node, ast.Import | ast.ImportFrom) and target in set(imported(node))]
    assert all(id(node) in inside for node in closing)


def test_no_import_is_hidden() -> None:
    hidden = {module: hidden_imports(parsed(module)) for module in MODULES}
    assert hidden.pop("ial.lazy") != []
    assert {module: calls for module, calls in hidden.items() if calls} == {}, "write an import statement, which every reader and tool sees"


@pytest.mark.parametrize(
    "text",
    [
        "import_module('ial.pose')",
        "importlib.import_module(f'ial.{x}')",
        "__import__('ial')",
        "import_module(name)",
        "import_module(f'{x}')",
        "import_module('.pose', 'ial')",
    ],
)
def test_hidden_imports_are_recognized(text: str) -> None:
    assert hidden_imports(ast.parse(text)) == [text]


@pytest.mark.parametrize("text", ["import_module('numba')", "import_module(f'automata.fa.{kind}')", "import_module('ialib')"])
def test_imports_of_others_are_not_hidden(text: str) -> None:
    assert hidden_imports(ast.parse(text)) == []


def test_a_room_names_the_file_of_its_own_nouns() -> None:
    files = [module for module, file in MODULES.items() if file.name != "__init__.py"]
    assert [module for module in files if f"ial.{room(module)}" in imports(module)] == [], "import from the file that defines the noun"


def test_no_vague_names() -> None:
    assert [str(file) for file in kept_files() if VAGUE & set(file.relative_to(ROOT).with_suffix("").parts)] == []


def looks_like_a_margin(node: ast.AST) -> bool:
    """Whether an expression is a number such as ``2.0**-40``, ``1e-9`` or ``1.01``."""
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow) and isinstance(node.right, ast.UnaryOp):
        return ast.unparse(node.left) in {"2", "2.0"} and 12 <= int(ast.unparse(node.right.operand)) <= 60
    return isinstance(node, ast.Constant) and re.fullmatch(r"[1-9]e-(0[5-9]|[1-5]\d)|1\.0(0\d*)?[1-9]\d*", repr(node.value)) is not None


@pytest.mark.parametrize("text", ["2.0**-48", "2 ** -20", "1.0 + 2.0**-40", "x * 1.01", "1e-9", "1.001", "5e-14"])
def test_margins_are_recognized(text: str) -> None:
    assert any(map(looks_like_a_margin, ast.walk(ast.parse(text))))


@pytest.mark.parametrize("text", ["2.0**16", "2.0**-300", "1.0", "0.5", "1e-3", "1.25", "1e5", "'1e-9'"])
def test_other_numbers_are_no_margins(text: str) -> None:
    assert not any(map(looks_like_a_margin, ast.walk(ast.parse(text))))


def test_margins_have_names_and_one_place() -> None:
    files = set()
    for module, file in MODULES.items():
        name = file.relative_to(ROOT).as_posix()
        if (
            name.startswith(
                ("contractors/", "maps/", "datasets/", "ial/active/", "ial/bouncing/", "ial/compass/", "ial/lidar/", "ial/odometer/")
            )
            and file.name != "margins.py"
        ):
            files |= {name for node in ast.walk(parsed(module)) if looks_like_a_margin(node)}
    assert files - NUMBERED.keys() == set(), "use a name of margins.py, and say what it covers"
    assert NUMBERED.keys() - files == set()


def test_what_every_bound_raises_is_said_once() -> None:
    """`RoundingModeError` says so itself, and where it comes from; no other docstring lists it."""
    listed = re.compile(r"^ +RoundingModeError$", re.MULTILINE)
    files = {file.relative_to(ROOT).as_posix() for file in MODULES.values() if listed.search(file.read_text())}
    assert files == {"contractors/rounding.py", "contractors/threads.py"}


def test_no_path_of_a_machine() -> None:
    path = re.compile(r"(?<![\w.])/(?:work|farm|home|root|Users|tmp)/\w")
    hits = []
    for file in kept_files():
        content = file.read_bytes()
        if b"\0" not in content:
            hits += [
                f"{file.relative_to(ROOT)}: {line.strip()}" for line in content.decode(errors="replace").splitlines() if path.search(line)
            ]
    assert hits == []


def test_the_reference_lists_every_public_name_of_the_toolkit() -> None:
    import ial.contractors

    page = (ROOT / "docs" / "api" / "contractors.md").read_text(encoding="utf-8")
    listed = {line.rpartition(".")[2] for line in page.splitlines() if line.strip().startswith("~ial.contractors.")}
    assert listed == set(ial.contractors.__all__)
