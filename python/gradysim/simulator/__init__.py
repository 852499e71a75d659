"""Prototype mode: an event simulator in pure Python, with an ideal network."""
