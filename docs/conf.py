"""The documentation site: `make docs` builds it with Sphinx, from Markdown and docstrings."""

import contextlib
import io
import shutil
from importlib import metadata
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sphinx.application import Sphinx


def make_replay() -> Path:
    """Record the run of a new project; return a directory with its page, `swarm.html`."""
    from gradysim.cli.app import main

    made = Path(__file__).parents[1] / "build" / "front_page"
    shutil.rmtree(made, ignore_errors=True)
    (made / "page").mkdir(parents=True)
    scenario = str(made / "swarm" / "swarm.ini")
    with contextlib.redirect_stdout(io.StringIO()):
        codes = [
            main(["new", str(made / "swarm")]),
            main(["run", scenario, "--quiet", "--replay", "all", "--result-dir", str(made)]),
        ]
    assert codes == [0, 0]
    (made / "General-#0.integrated.html").rename(made / "page" / "swarm.html")
    return made / "page"


project = "gradysim"
author = "The gradysim authors"
copyright = "The gradysim authors, MIT license"
release = metadata.version("gradysim")
version = release

extensions = [
    "myst_nb",  # Markdown and notebooks
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_copybutton",
    "cyclopts.ext.sphinx",
]
root_doc = "index"
smartquotes = False  # they turn -- of options into a dash
exclude_patterns = ["pictures/*.py"]
default_role = "py:obj"

# Markdown: links to headings as on GitHub.
myst_heading_anchors = 4
myst_enable_extensions = ["attrs_block", "attrs_inline"]

# Notebooks are stored without outputs. Each build executes them.
nb_execution_mode = "force"
nb_execution_in_temp = True
nb_execution_raise_on_error = True
nb_execution_timeout = 120

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_class_signature = "separated"
autodoc_default_options = {"members": True, "show-inheritance": True}
napoleon_google_docstring = True
napoleon_numpy_docstring = False
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 90

html_theme = "furo"
html_title = f"gradysim {release}"
html_show_sourcelink = False
html_copy_source = False

# The replay of the front page is made with the site.
html_extra_path = [str(make_replay())]

# Tables of error rates are shown as csv, which the highlighter does not know.
suppress_warnings = ["misc.highlighting_failure"]


def without_declarations(*event: Any) -> tuple[str, None] | None:
    """Leave out the arguments of a class whose fields carry declarations: its page describes each field."""
    signature = event[5]
    return ("(…)", None) if signature and "Annotated[" in signature else None


def setup(app: "Sphinx") -> None:
    """Connect what the reference of the API needs."""
    app.connect("autodoc-process-signature", without_declarations)
