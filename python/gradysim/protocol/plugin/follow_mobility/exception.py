"""The exception of both plugins."""


class FollowMobilityException(Exception):  # noqa: N818 (the published name)
    """A leader that cannot be followed, a value out of its range, or a message that makes no sense."""
