"""Replays: a complete record of a run, in one HTML file that any browser shows.

A run is recorded in chunks of at most 60 s of simulated time. `tables` declares the content of a chunk,
`chunk` packs it, and `file` writes chunks into the HTML file. `read_replay` returns the tables.
"""

from gradysim.replay.reader import Replay, read_replay

__all__ = ["Replay", "read_replay"]
