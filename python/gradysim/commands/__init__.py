"""The commands of the command line, a file for each; `gradysim.cli` puts them together.

What only one command needs is imported inside it, so that `gradysim --help` answers at once.
"""
