"""`python -m gradysim` is the command `gradysim`."""

import sys

from gradysim.cli.app import main

sys.exit(main())
