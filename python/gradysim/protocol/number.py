"""Which Python values are numbers, for results that hold nothing else."""

from numbers import Real


def as_float(value: object) -> float | None:
    """Return a number, a bool included, as a float; None for what is none, or too large for a float.

    Numbers of numpy are numbers, too, and its arrays without a dimension, `numpy.array(5)`; an array of one
    number is a list, as `plain_value` has it. Never raises.
    """
    try:
        if type(value).__module__ == "numpy" and hasattr(value, "tolist"):
            if getattr(value, "ndim", 0):  # not to make a list of all its items
                return None
            value = value.tolist()
        return float(value) if isinstance(value, Real) else None
    except Exception:  # too large, or a user's class that does not work
        return None
