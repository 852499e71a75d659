"""The commands on docs/how-to/run-on-a-cluster.md print what is shown. SLURM's programs are toys."""

import json
import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

from gradysim.cli.dask_workers import WITHOUT_WORKERS_S
from gradysim.cli.errors import OK
from gradysim.cli.run_all import text_of_unfinished

GUIDE = "docs/how-to/run-on-a-cluster.md"

CodeBlocks = Callable[[str, str], list[str]]
Shell = Callable[[str, Path], str]

SBATCH = f"""#!{sys.executable}
import os
import subprocess
import sys

array, command = sys.argv[1].removeprefix("--array="), sys.argv[sys.argv.index("--wrap") + 1]
first, last = map(int, array.split("-"))
names = {{"MIN": first, "MAX": last, "STEP": 1, "COUNT": last - first + 1}}
shared = {{f"SLURM_ARRAY_TASK_{{name}}": str(number) for name, number in names.items()}}
for task in range(first, last + 1):
    variables = {{**os.environ, **shared, "SLURM_ARRAY_TASK_ID": str(task)}}
    subprocess.run(["bash", "-euc", command], env=variables, check=True, stdout=subprocess.DEVNULL)
"""


@pytest.fixture
def slurm(shell: Shell, tmp_path: Path) -> None:
    """Make a program `sbatch` that computes an array, one task after the other."""
    program = tmp_path / "bin" / "sbatch"
    program.write_text(SBATCH)
    program.chmod(0o755)


@pytest.mark.verify
@pytest.mark.usefixtures("slurm")
def test_an_array_does_all_runs(
    code_blocks: CodeBlocks, shell: Shell, shows: Callable[..., None], tmp_path: Path
) -> None:
    (commands,) = code_blocks(GUIDE, "sh")
    shows(GUIDE, shell(commands, tmp_path), part=True)


@pytest.mark.verify
def test_a_share_and_what_is_missing_are_as_shown(
    code_blocks: CodeBlocks, shell: Shell, shows: Callable[..., None], swarm: Path
) -> None:
    for number, block in enumerate(code_blocks(GUIDE, "console")):
        commands = re.findall(r"^\$ (.*)\n", block, re.MULTILINE)
        printed = [f"$ {command}\n{shell(f'{command} || test $? -eq 5', swarm)}" for command in commands]
        shows(GUIDE, "".join(printed), number, changing=True, language="console")


def test_the_script_of_a_job_runs(code_blocks: CodeBlocks, shell: Shell, swarm: Path) -> None:
    (script,) = code_blocks(GUIDE, "bash")
    (swarm / "study.sh").write_text(script.replace("--stop-after 55min", "--stop-after 1us"))
    (swarm / "bin" / "scontrol").write_text('#!/bin/sh\necho "$@"\n')
    (swarm / "bin" / "scontrol").chmod(0o755)
    names = {"MIN": 0, "MAX": 3, "STEP": 1, "COUNT": 4, "ID": 2}
    variables = " ".join(f"SLURM_ARRAY_TASK_{name}={number}" for name, number in names.items())
    command = f"env {variables} SLURM_ARRAY_JOB_ID=12 bash study.sh"
    assert shell(command, swarm).splitlines()[-1] == "requeue 12_2"
    (swarm / "study.sh").write_text(script)
    assert "requeue" not in shell(command, swarm)
    assert len(list((swarm / "results").iterdir())) == 5


def test_what_dask_prints_is_as_shown(code_blocks: CodeBlocks) -> None:
    *_, here, _, lost = code_blocks(GUIDE, "text")
    assert here.splitlines()[-1] == "--executor dask: 2 workers on this machine, as no --scheduler is given"
    runs = text_of_unfinished("Study", range(20), dict.fromkeys(range(12), OK), under_way=range(12, 18))
    assert lost.endswith(f"; {runs}\n")


def test_the_patience_is_as_the_guide_says(root: Path) -> None:
    assert f"no worker for {WITHOUT_WORKERS_S:g} s" in (root / GUIDE).read_text()


@pytest.mark.verify
def test_another_executor_computes_the_study(code_blocks: CodeBlocks, swarm: Path) -> None:
    (program,) = code_blocks(GUIDE, "python")
    (swarm / "pool.py").write_text(program)
    subprocess.run([sys.executable, "pool.py"], cwd=swarm, env=dict(os.environ), check=True)
    results = [json.loads(file.read_text()) for file in (swarm / "pool").glob("*.json")]
    assert sorted(result["run"] for result in results) == list(range(20))
