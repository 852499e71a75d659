"""Prototype mode: a scenario goes in, runs on the plain simulator in Python, and results come out."""
