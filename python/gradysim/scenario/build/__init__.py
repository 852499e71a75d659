"""Scenarios, built from rows."""
