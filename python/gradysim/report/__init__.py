"""What the command line shows of a run: how far it is, what came out, where it failed."""
