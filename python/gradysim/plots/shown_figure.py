"""Figure that a notebook shows by itself. Others appear only after `%matplotlib inline`."""

from io import BytesIO

from matplotlib import rc_context
from matplotlib.figure import Figure

_DOTS_PER_INCH = 160


class ShownFigure(Figure):
    """A figure of matplotlib without a window."""

    def _repr_png_(self) -> bytes:
        """Return the picture. Notebooks call this for the value of a cell."""
        from gradysim.plots.figure import STYLE

        picture = BytesIO()
        with rc_context(STYLE):
            self.savefig(picture, format="png", dpi=_DOTS_PER_INCH)
        return picture.getvalue()
