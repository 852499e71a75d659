"""Fixtures of the comparisons: they report findings, and with --verify they draw pictures."""

import itertools
import json
import re
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path

import pytest

from findings import record
from verification.finding import FieldRow, Finding, field_table, table

_PAGES = Path(__file__).parents[2] / "docs" / "verification"
_FIELD = _PAGES / "field.md"
_BLOCK = re.compile(r"(<!-- table: written by `make verify` -->\n).*?(<!-- end of table -->)", re.DOTALL)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--verify",
        action="store_true",
        help="also run what is marked `verify`, print the findings, draw the pictures and write the table of "
        "docs/verification",
    )


def pytest_configure(config: pytest.Config) -> None:
    if config.getoption("--verify"):
        config.option.markexpr = ""


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Skip tests that only draw if no pictures are requested, since matplotlib may be missing."""
    only_draws = collection_path.name.endswith("_picture.py")
    return True if only_draws and not config.getoption("--verify") else None


@pytest.fixture(autouse=True)
def _engine() -> None:
    pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")


@pytest.fixture
def cited(
    record_property: Callable[[str, object], None], request: pytest.FixtureRequest
) -> Callable[[str], None]:
    """`cited(value)` writes a row of findings.csv, with --verify.

    Its id is the name of the file and of the test, with a number if the test has several.
    """
    count = itertools.count(1)

    def write_down(value: str) -> None:
        number = next(count)
        file, test = (each.removeprefix("test_") for each in (request.path.stem, request.node.name))
        name = f"{file}.{test}" + f".{number}" * (number > 1)
        command = f"pytest tests/verification/{request.path.name} --verify"
        record_property("cited", json.dumps([name, value, "", command]))

    return write_down


@pytest.fixture
def report(
    record_property: Callable[[str, object], None], cited: Callable[[str], None]
) -> Callable[[Finding], None]:
    """`report(finding)` records the finding, and fails the test if it does not agree."""

    def write_down(finding: Finding) -> None:
        record_property("finding", json.dumps(asdict(finding)))
        cited(finding.number)
        assert finding.agrees, str(finding)

    return write_down


@pytest.fixture
def field(
    record_property: Callable[[str, object], None],
    cited: Callable[[str], None],
    request: pytest.FixtureRequest,
) -> Callable[[FieldRow], None]:
    """`field(row)` records a row of field.md, and fails the test if the page has another one.

    With --verify, the page is written instead. A row that does not agree stays in it.
    """

    def write_down(row: FieldRow) -> None:
        record_property("field", json.dumps(asdict(row)))
        cited(f"measured: {row.measured}; engine: {row.engine}; fitted: {row.fitted or 'nothing'}")
        if not request.config.getoption("--verify"):
            assert str(row) in _FIELD.read_text(encoding="utf-8").splitlines()

    return write_down


@pytest.fixture
def picture(request: pytest.FixtureRequest) -> Callable[[str, Callable[[Path], None]], None]:
    """`picture(name, draw)` calls `draw(path of the file)` if pictures are requested."""

    def draw_if_wanted(name: str, draw: Callable[[Path], None]) -> None:
        if request.config.getoption("--verify"):
            draw(_PAGES / name)

    return draw_if_wanted


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    if not config.getoption("--verify") or config.getoption("collectonly"):
        return
    properties = [
        (name, str(value))
        for outcome in ("passed", "failed")
        for report in terminalreporter.getreports(outcome)
        for name, value in report.user_properties
    ]
    findings = [Finding(**json.loads(value)) for name, value in properties if name == "finding"]
    rows = [FieldRow(**json.loads(value)) for name, value in properties if name == "field"]
    for arguments in (json.loads(value) for name, value in properties if name == "cited"):
        record(*arguments)
    terminalreporter.section("findings")
    for found in (*findings, *rows):
        terminalreporter.write_line(str(found))
    is_complete = not config.getoption("keyword") and len(config.args) == 1 and "::" not in config.args[0]
    if is_complete and Path(config.args[0]).resolve() == Path(__file__).parent:
        _write_table(_PAGES / "README.md", table(findings))
        _write_table(_FIELD, field_table(rows))


def _write_table(page: Path, text: str) -> None:
    page.write_text(_BLOCK.sub(lambda block: block[1] + text + block[2], page.read_text()))
