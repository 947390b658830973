"""Sphinx builds the documentation from this; `make docs` turns every warning into an error."""

import os
import re
import runpy
import shlex
from importlib.metadata import version as version_of
from pathlib import Path

project = "ial"
author = "the authors of ial"
copyright = author
release = version = version_of("ial")

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
]
exclude_patterns = ["_build"]
templates_path = ["_templates"]

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autosummary_generate = True
myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3
napoleon_google_docstring = False
napoleon_use_ivar = True
napoleon_use_rtype = False  # what stands there is the name of a result, and no class to link to

html_theme = "sphinx_book_theme"
html_title = "ial"
# The bar at the side is made anew for each page; with the pages of every class in it, that took most of the time of the whole build.
html_theme_options = {
    "show_toc_level": 2,
    "max_navbar_depth": 1,
    "collapse_navbar": True,
    "use_download_button": False,
    "use_fullscreen_button": False,
}


def draw_pictures(app):
    """Run the examples of the pages, which write the pictures that the pages show."""
    import matplotlib

    matplotlib.use("Agg")
    docs = Path(__file__).resolve().parent
    examples = runpy.run_path(str(docs / "examples.py"))
    pictures = docs / "_build" / "pictures"
    pictures.mkdir(parents=True, exist_ok=True)
    here = Path.cwd()
    os.chdir(pictures)
    try:
        for name in examples["PAGES"]:
            for section in examples["sections"](docs / name).values():
                examples["run"](docs / name, section)
        draw_bounces((docs / "bouncing.md").read_text(encoding="utf-8"))
        draw_floor_plan((docs / "floor-plan.md").read_text(encoding="utf-8"))
        for name in ("compass", "odometer"):
            draw_shown((docs / f"{name}.md").read_text(encoding="utf-8"))
        draw_explorations(docs)
    finally:
        os.chdir(here)


def draw_bounces(page):
    """Run the commands of the page about the bouncing robot that lead to its pictures, on the environment that it shows."""
    from ial.cli.main import app

    Path("hall.wkt").write_text(re.search(r"```text\n(POLYGON .*)", page)[1])
    for command in re.findall(r"^\$ ial (bounce (?:build|simulate|show) (?:hall|disk).*)$", page, re.MULTILINE):
        if "store" not in command:
            app([*shlex.split(command), "--overwrite"], standalone_mode=False)


def draw_floor_plan(page):
    """Draw the plan of its page, and run the commands there."""
    from ial.cli.main import app

    exec(re.search(r"```python\n(.*?)```", page, re.DOTALL)[1], {})
    for command in re.findall(r"^\$ ial (bounce (?:build|simulate|show) .*)$", page, re.MULTILINE):
        app([*shlex.split(command), "--overwrite"], standalone_mode=False)


def draw_shown(page):
    """Run the commands of a page that plan and show."""
    from ial.cli.main import app

    for command in re.findall(r"^\$ ial (\w+ (?:plan|show) .*)$", page, re.MULTILINE):
        app([*shlex.split(command), "--overwrite"], standalone_mode=False)


def draw_explorations(docs):
    """Run the explorations of their page: the film and the tree that a command leaves, and the runs of its figures."""
    from ial.cli.main import app

    for command in re.findall(r"^\$ ial (explore .* --animate .*)$", (docs / "exploring.md").read_text(encoding="utf-8"), re.MULTILINE):
        app([*shlex.split(command), "--overwrite"], standalone_mode=False)
    runpy.run_path(str(docs / "explorations.py"))["draw"](Path.cwd())


def draw_house(app):
    """Draw who imports whom."""
    docs = Path(__file__).resolve().parent
    picture = docs / "_build" / "pictures" / "house.png"
    picture.parent.mkdir(parents=True, exist_ok=True)
    runpy.run_path(str(docs / "house.py"))["draw"](picture)


def setup(app):
    """Draw before anything is read."""
    app.connect("builder-inited", draw_pictures)
    app.connect("builder-inited", draw_house)
