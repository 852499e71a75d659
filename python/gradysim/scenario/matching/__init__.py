"""Which line is meant for what: groups of nodes, the entry in force, and keys that match nothing."""
