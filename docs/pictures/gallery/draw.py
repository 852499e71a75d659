"""Draws the figures of docs/gallery.md: `make figures` runs the commands of each example in a copy of it."""

import os
import shlex
import shutil
import tempfile
from pathlib import Path

from gradysim.cli import examples
from gradysim.cli.app import main

HERE = Path(__file__).parent

MORE_COMMANDS = {
    "search": [
        "gradysim run search.ini --vectors all --quiet --result-dir results/map",
        "gradysim plot results/map --kind map -o results/search-map.png",
    ],
    "collision_avoidance": [
        "gradysim run collision_avoidance.ini --vectors all --quiet --result-dir results/map",
        "gradysim plot results/map --kind map -o results/collision_avoidance-map.png",
    ],
    "sensor_field": [
        *(
            f"gradysim run sensor_field.ini -c {config} --quiet --result-dir results/figure"
            for config in ("Spread", "Gateway", "Synchronised")
        ),
        'gradysim plot results/figure --kind outcomes --x config --metric "unicast messages"'
        " -o results/sensor_field.png",
    ],
}
"""Commands beside those in the head of an example's .ini file."""


def draw(name: str, folder: Path) -> None:
    """Run the commands of an example that lead to figures, and keep the figures."""
    os.chdir(folder)
    assert main(["new", "--example", name]) == 0
    os.chdir(name)
    commands = [*examples.commands(name), *MORE_COMMANDS.get(name, [])]
    for command in commands if any("gradysim plot" in command for command in commands) else []:
        _, word, *arguments = shlex.split(command, comments=True)
        if word == "plot" or "--result-dir" in arguments:
            assert main([word, *arguments]) == 0
    for figure in Path("results").glob(f"{name}*.png"):
        shutil.copy(figure, HERE)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as directory:
        for example in examples.NAMES:
            if example != "scouts":  # docs/how-to/plot-a-study.md shows its figures
                draw(example, Path(directory))
