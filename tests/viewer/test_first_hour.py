"""What a new user does in the first hour, with a wheel in an environment of its own and in a browser."""

import csv
import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path
from urllib.parse import quote

import pytest

compiled = pytest.importorskip("gradysim._netsim")
build = pytest.importorskip("scikit_build_core.build")

ROOT = Path(__file__).parents[2]
ROWS = "[...document.querySelectorAll('.details td')].map((cell) => cell.textContent).join(' | ')"
EXECUTE = """
import sys, nbclient, nbformat
notebook = nbformat.read(sys.argv[1], as_version=4)
nbclient.NotebookClient(notebook, kernel_name="python3").execute()
for cell in notebook.cells:
    print(*[output.output_type for output in cell.get("outputs", [])])
"""

pytestmark = pytest.mark.verify


def pinned(*names):
    """Return these packages with the versions of the project."""
    groups = tomllib.loads((ROOT / "pyproject.toml").read_text())["dependency-groups"]
    return [package for package in groups["test"] if package.split("==")[0] in names]


class User:
    """A new user: a directory, and the commands of an environment."""

    def __init__(self, commands, folder):
        self.folder = folder
        hidden = {"PYTHONPATH", "VIRTUAL_ENV", "COLUMNS"}
        self.variables = {name: value for name, value in os.environ.items() if name not in hidden}
        self.variables["PATH"] = f"{commands}{os.pathsep}{os.environ['PATH']}"
        self.variables["JUPYTER_PREFER_ENV_PATH"] = "1"

    def __call__(self, command, *more):
        """Run a command as the user types it, and return what it prints."""
        done = subprocess.run(
            ["bash", "-euc", command, "bash", *more],
            cwd=self.folder,
            env=self.variables,
            capture_output=True,
            text=True,
        )
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    def replay(self, file, *options):
        """Run a configuration, and return the file of its replay."""
        results = self.folder / f"replay{len(list(self.folder.glob('replay*')))}"
        self(f'gradysim run {file} "$@" --quiet --replay all --result-dir {results.name}', *options)
        (page,) = results.glob("*.html")
        return quote(str(page))


@pytest.fixture(scope="module")
def user(tmp_path_factory):
    """Install the wheel with what a user installs, and the engine as it is compiled here."""
    folder = tmp_path_factory.mktemp("user")
    before = Path.cwd()
    os.chdir(ROOT)
    try:
        wheel = folder / build.build_wheel(str(folder), {"wheel.cmake": "false"})
    finally:
        os.chdir(before)
    subprocess.run([sys.executable, "-m", "venv", folder / "env"], check=True)
    commands = folder / "env/bin"
    packages = pinned("matplotlib", "nbclient", "ipykernel")
    subprocess.run([commands / "pip", "install", "--quiet", wheel, *packages], check=True)
    (package,) = (folder / "env/lib").glob("python*/site-packages/gradysim")
    shutil.copy(Path(compiled.__file__), package)
    (folder / "home").mkdir()
    for language, name in (("python", "hello.py"), ("ini", "hello.ini")):
        (block,) = re.findall(
            rf"^```{language}\n(.*?)^```", (ROOT / "README.md").read_text(), re.MULTILINE | re.DOTALL
        )
        (folder / "home" / name).write_text(block, encoding="utf-8")
    return User(commands, folder / "home")


@pytest.fixture(scope="module")
def screenshots(user):
    """Return the directory for what the page shows; to look at it, give pytest `--basetemp`."""
    folder = user.folder.parent / "screenshots"
    folder.mkdir()
    return folder


def test_the_package_is_that_of_the_environment(user):
    assert user('python -c "import gradysim; print(gradysim.__file__)"').startswith(str(user.folder.parent))


@pytest.mark.parametrize(("mode", "heard"), [("prototype", 180), ("integrated", 0)])
def test_hello(user, mode, heard):
    result = json.loads(user(f"gradysim run hello.ini --mode {mode} --json --quiet"))
    assert [node["tracked_variables"]["heard"] for node in result["nodes"]] == [heard] * 4


def test_hello_is_shown(user, browser):
    view = subprocess.Popen(
        ["gradysim", "view", "hello.ini", "--no-browser"],
        executable=user.folder.parent / "env/bin/gradysim",
        cwd=user.folder,
        env=user.variables,
        stdout=subprocess.PIPE,
        text=True,
    )
    with view:
        said = browser(None, url=view.stdout.readline().strip(), after=1, keys=[{"until": "sensors[3]"}])
        assert view.wait(60) == 0
    assert said["console"] == []


@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize(("width", "height"), [(1400, 850), (800, 1000), (390, 844)])
def test_a_loss_is_explained_on_each_screen(user, browser, screenshots, width, height, dark):
    said = browser(
        user.replay("hello.ini"),
        keys=["Shift+ArrowRight", {"until": "&frame="}],
        width=width,
        height=height,
        dark=dark,
        screenshot=str(screenshots / f"hello-{width}{'-dark' * dark}.png"),
    )
    assert not said["scrolls_sideways"]
    assert said["colors"] > 20
    assert "transmitting" in said["text"]


CAUSES = {
    "distance": ("town", "-c OpenField --set *.drones[*].mobility.initialX=1.2km", r"needs .* dB short"),
    "house": ("town", "-c Concrete", r"West block"),
    "noise": ("zigzag", "-c ZigZag15 --set sim-time-limit=200s", r"SINR [\d.]+ dB, half of such frames need"),
    "interference": ("hidden_terminals", "--set sim-time-limit=3s", r"with drones\[\d\] .*SINR .*needs"),
    "receiver transmitting": ("leader_election", "", r"transmitting"),
}
"""{cause of a loss: example, options of its run, what the page says}."""


@pytest.mark.parametrize("cause", CAUSES)
def test_a_loss_of_each_cause_is_explained(user, browser, screenshots, cause):
    example, options, words = CAUSES[cause]
    if not (user.folder / example).exists():
        user(f"gradysim new --example {example}")
    page = user.replay(f"{example}/{example}.ini", *options.split())
    outcome = {"distance": "below sensitivity", "house": "below sensitivity"}.get(cause, cause)
    said = browser(
        page,
        address=f"#t=0&filter=outcome:{outcome}",
        keys=["ArrowRight", {"until": "&frame="}],
        values={"rows": ROWS},
        screenshot=str(screenshots / f"{cause}.png"),
    )
    assert re.search(words, said["values"]["rows"])


def test_the_notebook_of_the_guide_runs(user):
    user("mkdir -p notebook")
    notebook = user(
        'python -c "import gradysim, pathlib; print(pathlib.Path(gradysim.__file__).parent)"'
    ).strip()
    page = f"{notebook}/docs/how-to/use-it-in-a-notebook.ipynb"
    printed = user('cd notebook && python -c "$1" "$2"', EXECUTE, page)
    assert "error" not in printed
    assert "display_data" in printed


def test_a_comparison_of_the_modes_has_no_unpaired_row(user):
    user("gradysim new swarm")
    for mode in ("prototype", "integrated"):
        user(f"gradysim run swarm/swarm.ini -c Study --mode {mode} --set repeat=2 --quiet --result-dir study")
    rows = list(csv.DictReader(user("gradysim compare study --by mode --csv").splitlines()))
    assert rows
    assert {row["pairs"] for row in rows} == {"2"}
