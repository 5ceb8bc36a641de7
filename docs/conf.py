"""Sphinx configuration: `make docs` builds docs/_build/html, and any warning fails it."""

import os
import shutil
import sys
from importlib.metadata import distribution
from pathlib import Path

import lasersph

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE / "_extensions"), str(HERE)]
# cells of the notebooks call the program of this environment, and show the figures that they draw
os.environ["PATH"] = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
os.environ.pop("MPLBACKEND", None)
os.environ["IPYTHONDIR"] = str(HERE / "generated" / "ipython")
STARTUP = HERE / "generated" / "ipython" / "profile_default" / "startup"
STARTUP.mkdir(parents=True, exist_ok=True)
shutil.copy(HERE / "_extensions" / "shell_cells.py", STARTUP)

project = "lasersph"
author = "The lasersph developers"
copyright = "The lasersph developers, BSD-3-Clause"
version = release = lasersph.__version__

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.mathjax",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
    "docstring_equations",
    "generated_pages",
    "units_in_tables",
]
exclude_patterns = ["_build", "generated/*.md", "generated/ipython"]
myst_enable_extensions = ["amsmath", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3
nb_execution_mode = "force"
nb_execution_in_temp = True
nb_execution_timeout = 600
nb_execution_raise_on_error = True

html_title = f"lasersph {version}"
html_theme = "furo"
MATHJAX = distribution("sphinx-mathjax-offline").locate_file(
    "sphinx-mathjax-offline/static/mathjax"
)
"""MathJax as files, of which the one that draws formulas as pictures needs no other."""
html_static_path = ["_static", f"{MATHJAX}/tex-svg.js"]
html_css_files = ["page.css"]
mathjax_path = "tex-svg.js"
nb_ipywidgets_js = {}  # no widget is shown, and its scripts would come from a network

autodoc_typehints = "description"
autodoc_typehints_description_target = "documented"
autodoc_member_order = "bysource"
napoleon_google_docstring = True
napoleon_use_ivar = True  # attributes as a list: some classes have thirty
