"""gradysim: one protocol, run on ever more realistic networks of flying nodes."""
