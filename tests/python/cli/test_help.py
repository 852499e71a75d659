"""`gradysim --help` and `--version`."""

import re
import shlex
import subprocess
import sys

import pytest

from gradysim.cli.app import COMMANDS, app
from python.cli.command import environment


def test_help_names_the_commands(gradysim):
    done = gradysim("--help")
    assert done.returncode == 0
    assert "run " in done.stdout
    assert "runs " in done.stdout


@pytest.mark.parametrize(
    "command", ["run", "check", "runs", "status", "means", "compare", "plot", "keys", "import", "calibrate"]
)
def test_help_of_a_command_has_a_text_for_each_option(gradysim, command):
    shown = re.findall(
        r"^│ *\*? *(--\S+)(?: (--?[\w-]+))?.*? {2,}\w", gradysim(command, "--help").stdout, re.MULTILINE
    )
    options = [argument.names for argument in app[command].assemble_argument_collection()]
    assert [tuple(filter(None, names)) for names in shown] == [
        names for names in options if names[0].startswith("--")
    ]


@pytest.mark.parametrize("group", COMMANDS)
def test_each_command_has_an_example_that_it_accepts(gradysim, group):
    for command, (function, _, example) in COMMANDS[group].items():
        called, _, _ = app.parse_args(shlex.split(example)[1:], exit_on_error=False)
        assert f"{called.__module__}:{called.__name__}" == f"gradysim.cli.{function}"
        assert f"Example: {example}" in gradysim(command, "--help").stdout


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("--jitter", "5"), "*.nodes[*].protocol.jitter=VALUE"),
        (("--job", "2"), "Did you mean --jobs?"),
        (("--resutl-dir=o",), "Did you mean --result-dir?"),
    ],
)
def test_an_unknown_option(gradysim, arguments, told):
    done = gradysim("run", "test.ini", *arguments)
    assert done.returncode == 2
    assert told in done.stderr


def test_help_loads_nothing_heavy(folder):
    code = "import sys; from gradysim.cli.app import main; main(['--help']); print(*sys.modules, sep='\\n')"
    done = subprocess.run(
        [sys.executable, "-c", code], env=environment(), capture_output=True, text=True, check=True
    )
    ours = {name for name in done.stdout.splitlines() if name.startswith("gradysim")}
    others = {name for name in ours if not name.startswith("gradysim.cli")}
    assert others == {"gradysim", "gradysim.installation"}
    heavy = {"numpy", "pandas", "matplotlib", "sqlite3", "asyncio", "rich.progress", "rich.markdown"}
    assert not heavy & set(done.stdout.splitlines())


def test_version(gradysim):
    done = gradysim("--version")
    assert done.returncode == 0
    assert done.stdout.strip()


def test_an_unknown_shell_has_no_completion(tmp_path):
    # Without SHELL, the name of the parent process decides, which may be bash here.
    code = (
        "import sys, cyclopts.completion.detect as detect\n"
        "detect.detect_shell = lambda: (_ for _ in ()).throw(detect.ShellDetectionError())\n"
        "from gradysim.cli.app import main\n"
        "sys.exit(main(['--install-completion']))"
    )
    settings = {**environment(), "HOME": str(tmp_path)}
    done = subprocess.run([sys.executable, "-c", code], env=settings, capture_output=True, text=True)
    assert (done.returncode, len(done.stderr.splitlines())) == (2, 1)
    assert list(tmp_path.iterdir()) == []
