"""Sphinx builds the documentation from this; `make docs` turns every warning into an error."""

from importlib.metadata import version as version_of

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

html_theme = "sphinx_book_theme"
html_title = "ial"
html_theme_options = {"show_toc_level": 2, "use_download_button": False, "use_fullscreen_button": False}
