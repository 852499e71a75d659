"""A replay in a cell of a notebook."""

from html import escape
from pathlib import Path

HEIGHT_PX = 640


class ReplayView:
    """The page of a replay, which a notebook shows as a frame. The notebook then contains the whole page."""

    def __init__(self, page: str, height_px: int = HEIGHT_PX) -> None:
        """`page` is the text of an HTML file of `gradysim run --replay`."""
        self._page = page
        self._height_px = height_px

    @staticmethod
    def of_file(file: Path, height_px: int = HEIGHT_PX) -> "ReplayView":
        """Read the page. Raises OSError."""
        return ReplayView(file.read_text(encoding="utf-8"), height_px)

    def _repr_html_(self) -> str:
        return (
            f'<iframe title="replay" width="100%" height="{self._height_px}" sandbox="allow-scripts"'
            f' style="border: 0" srcdoc="{escape(self._page)}"></iframe>'
        )
