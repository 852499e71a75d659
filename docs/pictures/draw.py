"""Draws the pictures of the README and the guides from runs: `make pictures`."""

import json
import os
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote

from PIL import Image

from gradysim.cli.app import main
from gradysim.integrated.run import IntegratedRun
from gradysim.replay.sink import ReplayWriter
from gradysim.scenario import load_scenarios

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
CONFIGS = ROOT / "configs"


def pictures(
    folder: Path, file: Path, config: str, limit: str, address: str, times_s: Sequence[float], scale: int = 1
) -> list[Image.Image]:
    """Run a configuration, and return what its replay shows at those times."""
    scenario, *_ = load_scenarios(file, config, overrides=[f"sim-time-limit={limit}"])
    replay = folder / "replay.html"
    IntegratedRun(scenario, replay=ReplayWriter(replay)).execute()
    return film(folder, replay, address, times_s, scale=scale)


def film(
    folder: Path,
    replay: Path,
    address: str,
    times_s: Sequence[float | None],
    size: tuple[int, int] = (900, 560),
    scale: int = 1,
) -> list[Image.Image]:
    """Return what a replay shows at those times; None is the time of the address.

    `size` is the size of the page, and a picture has `scale` times as many pixels.
    """
    width, height = size
    asked = {"file": quote(str(replay)), "address": address, "width": width, "height": height, "scale": scale}
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
    save(picture, shot.name)


def save(picture: Image.Image, name: str) -> None:
    """Write a picture of a guide."""
    few_colors = picture.quantize(256, Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    few_colors.save(HERE / f"{name}.png", optimize=True)


def draw_film(folder: Path) -> None:
    """Draw the film of a guide: reports that collide, and then with a random wait."""
    main(["new", str(folder / "swarm")])
    frames: list[Image.Image] = []
    for config in ("General", "Jittered"):
        times_s = [13.9 + 0.08 * number for number in range(16)]
        frames += pictures(folder, folder / "swarm/swarm.ini", config, "30s", "#", times_s, scale=2)
    fullest = max(frames, key=lambda frame: len(frame.getcolors(1 << 24) or []))
    colors = fullest.quantize(128, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
    film = [frame.quantize(palette=colors, dither=Image.Dither.NONE) for frame in frames]
    film[0].save(HERE / "replay.gif", save_all=True, append_images=film[1:], duration=120, loop=0)


@dataclass(frozen=True)
class TutorialShot:
    """A picture of a replay in the tutorial, run with the files as they are at the end of a page."""

    name: str
    page: str
    arguments: str
    time_s: float | None
    address: str
    size: tuple[int, int] = (900, 560)
    scale: int = 1


TUTORIAL_SHOTS = (
    TutorialShot("hello", "1-hello", "--mode prototype", 10.02, "#"),
    TutorialShot("at-once", "2-moving-nodes", "", 10.00004, "#"),
    TutorialShot("base", "4-groups-and-parameters", "-c Crowded", 40.0008, "#node=base"),
    TutorialShot(
        "interference",
        "7-what-was-lost",
        "-c Study -r 20",
        None,
        "#frame=114&filter=outcome:interference",
    ),
    TutorialShot(  # the first picture of the README
        "collision",
        "7-what-was-lost",
        "-c Study -r 20",
        None,
        "#frame=114&filter=outcome:interference",
        (1100, 680),
        2,
    ),
    TutorialShot(
        "sequence",
        "7-what-was-lost",
        "-c Study -r 20",
        None,
        "#frame=114&filter=outcome:interference&sequence=1",
        (1100, 760),
    ),
)
TUTORIAL_BLOCK = re.compile(
    r"(?:(at the end of )?`(\w+\.\w+)`:\n\n(?:\{[^\n]*\}\n)?)?^```(\w+)\n(.*?)^```", re.MULTILINE | re.DOTALL
)


def draw_tutorial(folder: Path) -> None:
    """Play the tutorial, draw its replays, and keep the figures that its commands draw."""
    play = folder / "tutorial"
    play.mkdir()
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    for page in sorted((ROOT / "docs/tutorial").glob("[1-9]-*.md")):
        text = page.read_text()
        for added, name, language, block in TUTORIAL_BLOCK.findall(text):
            if name:
                with (play / name).open("a" if added else "w") as file:
                    file.write(block)
            elif language == "sh" and not re.search("pip install|gradysim view", block):
                subprocess.run(
                    ["sh", "-ec", block],
                    cwd=play,
                    env={**os.environ, "PATH": path},
                    check=True,
                    stdout=subprocess.DEVNULL,
                )
        for shot in TUTORIAL_SHOTS:
            if shot.page == page.stem:
                results = folder / shot.name
                arguments = [*shot.arguments.split(), "--replay", "all", "--result-dir", str(results)]
                main(["run", str(play / "hello.ini"), *arguments, "--quiet"])
                (replay,) = results.glob("*.html")
                (picture,) = film(folder, replay, shot.address, [shot.time_s], shot.size, shot.scale)
                save(picture, f"tutorial/{shot.name}")
        for name in re.findall(r"\]\(../pictures/tutorial/([\w-]+\.png)\)", text):
            if (play / name).exists():
                shutil.copy(play / name, HERE / "tutorial" / name)


def is_listening(port: int) -> bool:
    """Return whether a server listens on this port of this machine."""
    with socket.socket() as client:
        return client.connect_ex(("127.0.0.1", port)) == 0


def draw_viewer(folder: Path) -> None:
    """Draw what the guide to the visualization handler shows in the browser."""
    guide = (ROOT / "docs/how-to/use-the-visualization-handler.md").read_text()
    watch, climber = re.findall(r"^```python\n(.*?)^```", guide, re.MULTILINE | re.DOTALL)
    (ini,) = re.findall(r"^```ini\n(.*?)^```", guide, re.MULTILINE | re.DOTALL)
    (folder / "climber.py").write_text(climber)
    (folder / "watch.py").write_text(watch + "\nshow('watch.ini')\n")
    (folder / "watch.ini").write_text(ini.replace("10s", "1000s"))
    asked = {"url": "http://localhost:5678/#node=Climber%201", "after": 6, "pause": True}
    asked |= {"width": 900, "height": 560, "screenshot": str(folder / "viewer.png")}
    with subprocess.Popen([sys.executable, "watch.py"], cwd=folder) as run:
        try:
            while run.poll() is None and not is_listening(5678):
                time.sleep(0.1)
            browser = ROOT / "tests/viewer/browser.mjs"
            subprocess.run(
                ["node", browser], input=json.dumps(asked), text=True, check=True, stdout=subprocess.DEVNULL
            )
        finally:
            run.kill()
    save(Image.open(folder / "viewer.png").convert("RGB"), "viewer")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        draw_film(Path(name))
        for shot in SHOTS:
            draw_shot(Path(name), shot)
        draw_viewer(Path(name))
        draw_tutorial(Path(name))
    curve = HERE / "curve.png"
    main(
        ["calibrate", str(CONFIGS / "zigzag.ini"), "-c", "ZigZag5", "--range", "50m", "--picture", str(curve)]
    )
