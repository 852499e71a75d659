"""The runs of a configuration: what differs from run to run, and what tells whether two runs are the same."""
