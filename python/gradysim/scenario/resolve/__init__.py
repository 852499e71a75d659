"""Runs, and the rows of each: which line sets which parameter."""
