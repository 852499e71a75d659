"""The page that shows a run. `make viewer` builds it from the TypeScript sources in viewer/."""

import json
from collections.abc import Mapping
from importlib import resources
from typing import Any


def page() -> str:
    """Return the page, with a comment where the run goes."""
    return resources.files("gradysim.viewer").joinpath("page.html").read_text(encoding="utf-8")


def live_page(socket: str) -> str:
    """Return the page for a run that goes on; its chunks come from the WebSocket with that path."""
    return _page_with("gradysim-live", {"socket": socket})


def snapshot_page() -> str:
    """Return the page for a run that a `VisualizationHandler` shows."""
    return _page_with("gradysim-snapshots", {"socket": "/"})


def page_beside(socket: str, replays: Mapping[str, str]) -> str:
    """Return a page that shows several replays side by side: {address: name}."""
    return _page_with("gradysim-beside", {"socket": socket, "replays": replays})


def json_text(value: Mapping[str, Any]) -> str:
    """Return a value as JSON that cannot end the element that it is in."""
    return json.dumps(value, separators=(",", ":")).replace("<", "\\u003c")


def _page_with(element_id: str, value: Mapping[str, Any]) -> str:
    element = f'<script type="application/json" id="{element_id}">{json_text(value)}</script>\n'
    return page().replace("<!-- run -->", element)
