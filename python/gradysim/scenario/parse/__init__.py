"""The text of a file: sections and entries, patterns of keys, and the values of expressions."""
