"""The keys that a file may have, and the types of their values."""
