"""Handlers: one for communication, one for timers, one for mobility."""
