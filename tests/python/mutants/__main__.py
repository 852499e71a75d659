"""`make mutants`: changes the package at random places, and reports how many changes some test notices.

Package and tests are copied. Each mutant runs the tests of its file, then those of its folder and then those
of commands and modes, until some fail. A mutant that survives is printed: it shows a line that no test needs,
or a change that changes nothing.
"""

import os
import random
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import gradysim._netsim
from python.mutants.mutations import Mutation, mutations

ROOT = Path(__file__).parents[3]
PACKAGE = Path("python/gradysim")
NOT_COPIED = (".git", ".venv", "build", "dist", "node_modules", "__pycache__", "_netsim*.so")
LEFT_OUT = ("showcases", "cli/templates")
LAST_TESTS = ("scripting", "integrated", "prototype", "cli", "conformance")
MOST_S = 900
GOAL = 0.95


def main(count: int, seed: int) -> int:
    """Test mutants; return the exit code, 1 if too many survive."""
    rng = random.Random(seed)
    caught = 0
    with tempfile.TemporaryDirectory(prefix="mutants-") as folder:
        tree = copied(Path(folder) / "tree")
        for number in range(1, count + 1):
            file, mutation = sampled(tree, rng)
            source = file.read_bytes()
            is_caught = any(notices(tree, file, mutation, tests) for tests in tests_of(tree, file))
            caught += is_caught
            outcome = "caught" if is_caught else "SURVIVED"
            old = source[mutation.start : mutation.end].decode()
            place = f"{file.relative_to(tree)}:{mutation.line}"
            print(f"{number} {outcome} {place}: {old!r} -> {mutation.text!r}", flush=True)
    rate = caught / count
    print(f"{caught} of {count} mutants caught ({rate:.0%}, goal {GOAL:.0%}), seed {seed}")
    return 0 if rate >= GOAL else 1


def copied(tree: Path) -> Path:
    """Copy the package and its tests, and make an environment that imports the copy."""
    shutil.copytree(ROOT, tree, ignore=shutil.ignore_patterns(*NOT_COPIED))
    shutil.copy(gradysim._netsim.__file__, tree / PACKAGE)
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", tree / ".venv"], check=True)
    (site,) = (tree / ".venv/lib").glob("*/site-packages")
    packages = Path(gradysim._netsim.__file__).parents[1], *(Path(path) for path in sys.path if path)
    shared = dict.fromkeys(str(path) for path in packages if path.name == "site-packages")
    (site / "tree.pth").write_text("\n".join([str(tree / "python"), *shared]), encoding="utf-8")
    return tree


def sampled(tree: Path, rng: random.Random) -> tuple[Path, Mutation]:
    """Return a random mutation; each of the package is as likely as any other."""
    return rng.choice(all_mutations(tree))


@cache
def all_mutations(tree: Path) -> list[tuple[Path, Mutation]]:
    """Return the mutations of all files of the package."""
    files = [
        file
        for file in sorted((tree / PACKAGE).rglob("*.py"))
        if not file.relative_to(tree / PACKAGE).as_posix().startswith(LEFT_OUT)
    ]
    return [(file, mutation) for file in files for mutation in mutations(file.read_bytes())]


def tests_of(tree: Path, file: Path) -> Iterator[tuple[str, ...]]:
    """Yield sets of tests, the likeliest to fail first."""
    inside = file.relative_to(tree / PACKAGE)
    tests = Path("tests/python")
    for place in (inside.parent / f"test_{file.stem}.py", inside.parent, Path(inside.parts[0])):
        if place != Path() and (tree / tests / place).exists():
            yield (str(tests / place),)
    yield tuple(str(tests / name) for name in LAST_TESTS)


def notices(tree: Path, file: Path, mutation: Mutation, tests: tuple[str, ...]) -> bool:
    """Return whether tests that pass with the file as it is fail with a mutation."""
    source = file.read_bytes()
    file.write_bytes(mutation.applied(source))
    try:
        if passes(tree, tests):
            return False
    finally:
        file.write_bytes(source)
    return passes_unchanged(tree, tests)


@cache
def passes_unchanged(tree: Path, tests: tuple[str, ...]) -> bool:
    """Return whether tests pass without a mutation."""
    is_passed = passes(tree, tests)
    if not is_passed:
        print(f"these fail without a mutation, and are left out: {' '.join(tests)}", flush=True)
    return is_passed


def passes(tree: Path, tests: tuple[str, ...]) -> bool:
    """Return whether tests pass. If they do not end, they do not."""
    command = [tree / ".venv/bin/python", "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", *tests]
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    try:
        done = subprocess.run(command, cwd=tree, env=environment, capture_output=True, timeout=MOST_S)
    except subprocess.TimeoutExpired:
        return False
    return done.returncode in (0, 5)  # 5: there was none


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), int(sys.argv[2]) if sys.argv[2:] else random.randrange(2**32)))
