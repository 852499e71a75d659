"""Stand-in for the package gradys-embedded: the same public structure, for tests."""
