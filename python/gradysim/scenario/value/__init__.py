"""The text of one value: units, expressions, draws at random, and what the value has to be."""
