"""The engine does not depend on Python, and its includes go one way."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

ENGINE = Path("cpp/netsim")
# From the bottom up: a directory includes its own files and those of the directories before it. "" is the
# engine's root (units.hpp, error.hpp, interface_id.hpp).
LAYERS = [
    "",
    "kernel",
    "geometry",
    "config",
    "mobility",
    "trace",
    "propagation",
    "carrier_sense",
    "medium",
    "phy",
    "mac",
    "node",
]
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.MULTILINE)
PYTHON = re.compile(r"pybind11|\bPython\.h\b|\bPyObject\b|\bproxy_protocol\b")

ProjectFiles = Callable[..., list[Path]]


@pytest.fixture
def engine_files(project_files: ProjectFiles) -> list[Path]:
    return [file for file in project_files(".hpp", ".cpp") if file.is_relative_to(ENGINE)]


def layer(file: Path) -> str:
    """Return the directory of a file: "mac" for cpp/netsim/mac/dcf.hpp, "" for cpp/netsim/units.hpp."""
    parent = file.relative_to(ENGINE).parent
    return "" if parent == Path(".") else parent.parts[0]


def includes(file: Path) -> list[tuple[str, str]]:
    """Return (opening quote, path) of each include of the file."""
    return INCLUDE.findall(file.read_text())


def test_the_engine_does_not_know_python(root: Path, engine_files: list[Path]) -> None:
    assert engine_files
    assert [str(file) for file in engine_files if PYTHON.search((root / file).read_text())] == []


def test_only_the_proxy_includes_pybind11(root: Path, project_files: ProjectFiles) -> None:
    proxy = Path("cpp/proxy_protocol")
    offenders = [
        str(file)
        for file in project_files(".hpp", ".cpp")
        if not file.is_relative_to(proxy)
        for _, path in includes(root / file)
        if path.startswith("pybind11/")
    ]
    assert offenders == []


def test_only_one_header_prefetches(root: Path, engine_files: list[Path]) -> None:
    users = [str(file) for file in engine_files if "__builtin_prefetch" in (root / file).read_text()]
    assert users == ["cpp/netsim/kernel/prefetch.hpp"]


def test_every_folder_of_the_engine_has_its_layer(engine_files: list[Path]) -> None:
    assert sorted({layer(file) for file in engine_files} - set(LAYERS)) == []


def test_our_own_headers_are_included_by_their_full_name(root: Path, engine_files: list[Path]) -> None:
    offenders = [
        f"{file} includes {path}"
        for file in engine_files
        for quote, path in includes(root / file)
        if (quote == '"') != path.startswith("netsim/")
        or (quote == '"' and not (root / "cpp" / path).is_file())
    ]
    assert offenders == []


def test_includes_go_one_way(root: Path, engine_files: list[Path]) -> None:
    offenders = [
        f"{file} includes {path}"
        for file in engine_files
        for quote, path in includes(root / file)
        if quote == '"' and LAYERS.index(layer(Path("cpp") / path)) > LAYERS.index(layer(file))
    ]
    assert offenders == []


def test_no_header_includes_itself_through_others(root: Path, engine_files: list[Path]) -> None:
    graph = {
        str(file.relative_to("cpp")): [path for quote, path in includes(root / file) if quote == '"']
        for file in engine_files
        if file.suffix == ".hpp"
    }
    finished: set[str] = set()

    def cycle_from(header: str, trail: list[str]) -> list[str]:
        if header in trail:
            return [*trail[trail.index(header) :], header]
        if header not in finished:
            for included in graph.get(header, []):
                if found := cycle_from(included, [*trail, header]):
                    return found
            finished.add(header)
        return []

    assert [cycle for header in graph if (cycle := cycle_from(header, []))] == []
