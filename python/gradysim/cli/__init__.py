"""The command `gradysim`: its subcommands, their options and what they print. `app` is the entry point."""

import gradysim
from gradysim import installation

# Again: where gradysim 0.8 was installed last, `gradysim/__init__.py` is its own.
installation.check(gradysim.__path__)
