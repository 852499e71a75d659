"""Runs for scripts and notebooks: `gradysim.run`, with progress bars."""
