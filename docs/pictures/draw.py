"""Draws the pictures of the README and the guides from runs: `make pictures`."""

import json
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from PIL import Image

from gradysim.cli.app import main
from gradysim.integrated.run import IntegratedRun
from gradysim.replay.sink import ReplayWriter
from gradysim.scenario import load_scenarios

HERE = Path(__file__).parent
CONFIGS = HERE.parents[1] / "configs"


def pictures(
    folder: Path, file: Path, config: str, limit: str, address: str, times_s: Sequence[float]
) -> list[Image.Image]:
    """Run a configuration, and return what its replay shows at those times."""
    scenario, *_ = load_scenarios(file, config, overrides=[f"sim-time-limit={limit}"])
    replay = folder / "replay.html"
    IntegratedRun(scenario, replay=ReplayWriter(replay)).execute()
    asked = {"file": str(replay), "address": address, "width": 900, "height": 560}
    asked |= {"times": list(times_s), "directory": str(folder)}
    subprocess.run(["node", HERE / "film.mjs"], input=json.dumps(asked), text=True, check=True)
    return [Image.open(folder / f"{number:04}.png").convert("RGB") for number in range(len(times_s))]


@dataclass(frozen=True)
class Shot:
    """A picture of a replay: the name of its file, the run, and what of it is shown."""

    name: str
    file: str
    config: str
    time_s: float
    address: str


SHOTS = (
    Shot("trips", "scouts.ini", "General", 60, "#"),
    Shot("obstacles", "town/town.ini", "Concrete", 0.7, "#"),
)


def draw_shot(folder: Path, shot: Shot) -> None:
    """Draw a picture of a guide."""
    (picture,) = pictures(
        folder, CONFIGS / shot.file, shot.config, f"{shot.time_s + 2}s", shot.address, [shot.time_s]
    )
    picture.quantize(128, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE).save(
        HERE / f"{shot.name}.png", optimize=True
    )


def draw_film(folder: Path) -> None:
    """Draw the film of the README: reports that collide, and then with a random wait."""
    main(["new", str(folder / "swarm")])
    frames: list[Image.Image] = []
    for config in ("General", "Jittered"):
        times_s = [13.9 + 0.08 * number for number in range(16)]
        frames += pictures(folder, folder / "swarm/swarm.ini", config, "30s", "#", times_s)
    colors = frames[0].quantize(48, dither=Image.Dither.NONE)
    film = [frame.quantize(palette=colors, dither=Image.Dither.NONE) for frame in frames]
    film[0].save(HERE / "replay.gif", save_all=True, append_images=film[1:], duration=120, loop=0)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        draw_film(Path(name))
        for shot in SHOTS:
            draw_shot(Path(name), shot)
    curve = HERE / "curve.png"
    main(
        ["calibrate", str(CONFIGS / "zigzag.ini"), "-c", "ZigZag5", "--range", "50m", "--picture", str(curve)]
    )
