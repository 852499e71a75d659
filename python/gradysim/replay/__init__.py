"""Replays: everything that a run did, in one HTML file that shows itself in any browser.

A run is recorded in chunks of at most 60 s of simulated time. `tables` says what a chunk has, `chunk` how it
is packed, `file` how chunks lie in the HTML file, and `read_replay` gives the tables back.
"""

from gradysim.replay.reader import Replay, read_replay

__all__ = ["Replay", "read_replay"]
