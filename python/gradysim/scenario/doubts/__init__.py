"""Lines that are valid and probably do not do what their writer meant: what commands warn of."""
