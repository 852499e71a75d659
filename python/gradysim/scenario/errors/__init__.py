"""What is said to whoever wrote a mistake: where it stands, what was expected, and the nearest valid name."""
