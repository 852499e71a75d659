"""Integrated mode: a scenario goes in, runs on the compiled engine, and results come out."""
