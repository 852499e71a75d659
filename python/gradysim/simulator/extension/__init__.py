"""Equipment of a node in addition to its radio and its vehicle. A protocol creates its own extensions.

An extension bypasses the interface between protocol and environment. So not all extensions work in every
mode; each one names its modes.
"""
