"""Texts in quotes, as they are written in a value."""

QUOTED = r'"(?:[^"\\]|\\.)*"'
"""A regular expression, for re.DOTALL. A backslash takes the meaning from the character after it."""
