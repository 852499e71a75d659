"""`gradysim --help` and `--version`."""

import subprocess
import sys

from python.cli.command import environment


def test_help_names_the_commands(gradysim):
    done = gradysim("--help")
    assert done.returncode == 0
    assert "run " in done.stdout
    assert "runs " in done.stdout


def test_help_of_run_names_its_options(gradysim):
    text = gradysim("run", "--help").stdout
    for option in ("--config", "-c", "--runs", "-r", "--mode", "--set", "--result-dir", "--json", "--quiet"):
        assert option in text


def test_help_loads_nothing_heavy(folder):
    code = "import sys; from gradysim.cli import main; main(['--help']); print(*sys.modules, sep='\\n')"
    done = subprocess.run(
        [sys.executable, "-c", code], env=environment(), capture_output=True, text=True, check=True
    )
    ours = {name for name in done.stdout.splitlines() if name.startswith("gradysim")}
    assert {name for name in ours if not name.startswith("gradysim.commands")} == {"gradysim", "gradysim.cli"}
    heavy = {"numpy", "pandas", "matplotlib", "sqlite3", "asyncio", "rich.progress"}
    assert not heavy & set(done.stdout.splitlines())


def test_version(gradysim):
    done = gradysim("--version")
    assert done.returncode == 0
    assert done.stdout.strip()
