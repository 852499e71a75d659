"""`python -m gradysim` is the command `gradysim`."""

import sys

from gradysim.cli import main

sys.exit(main())
