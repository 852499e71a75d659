"""Draws the layers that tests enforce, for docs/contributing/architecture.md: `make pictures`."""

import ast
import io
import tomllib
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

from matplotlib import pyplot
from matplotlib.axes import Axes
from matplotlib.patches import FancyBboxPatch

ROOT = Path(__file__).parents[3]
PICTURE = ROOT / "docs/pictures/architecture.svg"

BLUE, GREEN, INK = "#2a6fb0", "#3c8d4f", "#20242a"
LOOK = {
    "font.size": 9,
    "text.color": INK,
    "svg.fonttype": "none",
    "svg.hashsalt": "gradysim",
    "font.family": "sans-serif",
}
STEP, HEIGHT, WIDTH = 0.72, 0.58, 5.4

CONTENTS = {
    "__main__": "python -m gradysim",
    "scripting": "gradysim.run",
    "cli": "commands, options, processes of runs",
    "ladder": "effects of real radios, level by level",
    "stepping": "runs in steps",
    "omnetpp_import": "OMNeT++ files",
    "prototype": "runs in Python",
    "integrated": "runs in C++",
    "plots": "figures",
    "execution": "runs in chunks, locks",
    "sitl": "autopilots and MAVLink",
    "results": "fields, files, tables of a run",
    "replay": "records of a run, traces, live views",
    "scenario": ".ini files",
    "simulator": "events and handlers",
    "motion": "physics of vehicles, wind, position errors",
    "encapsulator": "protocol to environment",
    "showcases": "GrADyS' protocols",
    "viewer": "page in a browser",
    "protocol": "interface, messages, plugins",
    "notebook": "tables and replays there",
    "installation": "check of installed files",
    "proxy_protocol": "bindings; Python protocols",
    "protocols": "native protocols",
    "node": "life of a node, timers, commands",
    "mac": "DCF, CSMA/CA, rate control",
    "phy": "radio, reception, antennas",
    "medium": "which radios a frame reaches",
    "carrier_sense": "energy of several frames",
    "propagation": "path loss, fading, obstacles",
    "trace": "outcomes, delays, captures",
    "mobility": "legs of motion, vehicles",
    "config": "fields of models, ranges",
    "geometry": "positions, directions, prisms",
    "kernel": "time, events, random numbers",
}


def python_layers() -> list[list[str]]:
    """Return the packages of gradysim from the top down: each imports only those in the rows below it."""
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    contracts = settings["tool"]["importlinter"]["contracts"]
    (layers,) = [contract["layers"] for contract in contracts if contract.get("containers") == ["gradysim"]]
    return [layer.split(" | ") for layer in layers]


def engine_layers() -> list[str]:
    """Return the directories of the engine from the top down: each includes only those below it."""
    source = (ROOT / "tests/python/house/test_engine_layers.py").read_text(encoding="utf-8")
    (layers,) = [
        ast.literal_eval(statement.value)
        for statement in ast.parse(source).body
        if isinstance(statement, ast.Assign) and ast.unparse(statement.targets[0]) == "LAYERS"
    ]
    return [layer for layer in reversed(layers) if layer]


def row(axes: Axes, x: float, y: float, names: list[str], color: str) -> dict[str, tuple[float, float]]:
    """Draw boxes side by side, and return the middle of the right edge of each."""
    gap = 0.12
    width = (WIDTH - gap * (len(names) - 1)) / len(names)
    edges = {}
    for number, name in enumerate(names):
        left = x + number * (width + gap)
        axes.add_patch(
            FancyBboxPatch(
                (left, y),
                width,
                HEIGHT,
                boxstyle="round,pad=0,rounding_size=0.06",
                facecolor=color + "22",
                edgecolor=color,
            )
        )
        middle = left + width / 2
        axes.text(middle, y + 0.39, name, ha="center", va="center", weight="bold", color=color)
        axes.text(middle, y + 0.16, CONTENTS[name], ha="center", va="center", fontsize=7)
        edges[name] = (left + width, y + HEIGHT / 2)
    return edges


def picture() -> str:
    """Return the picture as SVG."""
    with matplotlib.rc_context(LOOK):
        figure, axes = pyplot.subplots(figsize=(7.6, 6.0))
        edges: dict[str, tuple[float, float]] = {}
        packages, engine = python_layers(), ["protocols", *engine_layers()]
        top = STEP * max(len(packages), len(engine) + 1)
        right = WIDTH + 1
        for number, names in enumerate(packages):
            edges |= row(axes, 0, top - number * STEP, names, BLUE)
        row(axes, right, top, ["proxy_protocol"], BLUE)
        for number, name in enumerate(engine):
            row(axes, right, top - (number + 1) * STEP, [name], GREEN)
        for x, title in ((0, "python/gradysim"), (right, "cpp/proxy_protocol, protocols, netsim")):
            axes.text(x + WIDTH / 2, top + 0.8, title, ha="center", family="monospace", weight="bold")
        x, y = edges["integrated"]
        gap_y, arrow_y = y - STEP / 2, top + HEIGHT / 2
        path = [(x - 0.4, y - HEIGHT / 2), (x - 0.4, gap_y), (WIDTH + 0.4, gap_y), (WIDTH + 0.4, arrow_y)]
        axes.plot(*zip(*path, strict=True), color=INK, linewidth=1)
        axes.annotate("", (right, arrow_y), path[-1], arrowprops={"arrowstyle": "-|>", "color": INK})
        axes.set(xlim=(-0.1, right + WIDTH + 0.1), ylim=(top - len(engine) * STEP - 0.1, top + 1.2))
        axes.axis("off")
        written = io.StringIO()
        figure.savefig(
            written,
            format="svg",
            facecolor="white",
            bbox_inches="tight",
            metadata={"Date": None, "Creator": None},
        )
        pyplot.close(figure)
    return "\n".join(line.rstrip() for line in written.getvalue().splitlines()) + "\n"


if __name__ == "__main__":
    PICTURE.write_text(picture(), encoding="utf-8")
