"""The nodes of a scenario as plain data, and how they are built from the entries in force."""
