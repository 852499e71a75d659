"""What nodes run: the class that a file names, whether it is a protocol, and its parameters."""
