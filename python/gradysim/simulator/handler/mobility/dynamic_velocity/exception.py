"""What goes wrong with vehicles that are steered by velocity."""


class DynamicVelocityMobilityException(Exception):  # noqa: N818 (named as the other handlers' exceptions)
    """A command that a vehicle cannot carry out, or a node that is not known here."""
