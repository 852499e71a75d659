"""The documentation site: `make docs` builds it with Sphinx, from Markdown and docstrings."""

from importlib import metadata
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sphinx.application import Sphinx

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

# Tables of error rates are shown as csv, which the highlighter does not know.
suppress_warnings = ["misc.highlighting_failure"]


def without_declarations(*event: Any) -> tuple[str, None] | None:
    """Leave out the arguments of a class whose fields carry declarations: its page describes each field."""
    signature = event[5]
    return ("(…)", None) if signature and "Annotated[" in signature else None


def setup(app: "Sphinx") -> None:
    """Connect what the reference of the API needs."""
    app.connect("autodoc-process-signature", without_declarations)
