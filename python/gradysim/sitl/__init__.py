"""Autopilots beside a simulation: their processes, and their vehicles flown over MAVLink.

Knows no simulator: who lets nodes be flown by autopilots, in whatever mode, builds on this. Needs the extra
`sitl`, which is imported where it is used, and an autopilot, which the user brings.
"""
