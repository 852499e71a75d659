"""Scenarios with errors: files of the project and of a corpus, each changed at a few random places."""

import random
import re
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).parents[3]
LARGEST = 8000
"""Largest size of a changed file in bytes. Most errors need few lines."""

SOURCES = sorted(
    file
    for folder in ("configs", "examples", "tests/corpus/ini")
    for file in (ROOT / folder).rglob("*.ini")
    if file.stat().st_size <= LARGEST
)

BASES = [file for file in SOURCES if "sim-time-limit" in file.read_text(encoding="utf-8")]
"""Files that are not parts of others."""

_TOKEN = re.compile(r"\w+|\s+|[^\w\s]")

_TOKENS = (
    *"\"'`#\\{}[]()=:;,.*?!^%&|<>~$@/-+",
    *("\n", "\n ", "\r", "\t", "\f", " ", "\\\n", "\0", "\x1b", "\ufeff", "\u2028", "µ", "٣", "\U0001f681"),
    *("0", "-1", "1e308", "1e-308", "1e999", "0x10", "nan", "inf", "9" * 30, "9" * 400, "007", "1."),
    *("s", "m", "dBm", "mW", "mps", "deg", "5m 3s", "true", "default", '""', '"x"', '"../x.py:A"', ".5"),
    *("${", "${x}", "${1..3}", "${x=1, 2}", "${1, 2 ! x}", "${runnumber}", "${iterationvars}", "${1..1e9}"),
    *("**", "***", "[*]", "[0..]", "[3..1]", "{a-z}", "{^}", "uniform(0, 1)", "normal(0m, 1m)", "index"),
    *("max(", "1 ? 2 : 3", "2^9999", "9^9^9", "1/0", "=~", "(" * 60, "-" * 60, "*a" * 40, "x" * 1500),
)

_LINES = (
    "include part.ini",
    "include test.ini",
    "include /dev/zero",
    "include .",
    "[General]",
    "[Config X]",
    "[Config X] extends",
    "extends = X, General",
    "abstract = true",
    "repeat = 3",
    "constraint = $x < 3",
    "seed-set = ${repetition}",
    "network = a.b",
    "*.numUavs = ${1, 2}",
    "*.numX = 3",
    "**.typename = x",
    "**.wlan[7].radio.transmitter.power = 1mW",
    '**.protocol.class = "corpus.py:Quiet"',
    '*.x.protocol.class = "nowhere:Quiet"',
    "*.environment.numObstacles = 2",
    '*.environment.obstacles = "part.ini"',
    " continued",
    "no entry",
    "=",
    "a.b.c = ",
)


def _change_token(text: str, rng: random.Random) -> str:
    tokens = _TOKEN.findall(text)
    tokens[rng.randrange(len(tokens))] = rng.choice(_TOKENS)
    return "".join(tokens)


def _remove_token(text: str, rng: random.Random) -> str:
    tokens = _TOKEN.findall(text)
    del tokens[rng.randrange(len(tokens))]
    return "".join(tokens)


def _insert_token(text: str, rng: random.Random) -> str:
    place = rng.randrange(len(text) + 1)
    return text[:place] + rng.choice(_TOKENS) + text[place:]


def _change_value(text: str, rng: random.Random) -> str:
    lines = text.split("\n")
    place = rng.choice([number for number, line in enumerate(lines) if "=" in line] or [0])
    lines[place] = f"{lines[place].partition('=')[0]}= {rng.choice(_TOKENS)}{rng.choice(_TOKENS)}"
    return "\n".join(lines)


def _move_line(text: str, rng: random.Random) -> str:
    lines = text.split("\n")
    line = lines.pop(rng.randrange(len(lines))) if rng.random() < 0.5 else rng.choice(lines)
    lines.insert(rng.randrange(len(lines) + 1), line)
    return "\n".join(lines)


def _insert_line(text: str, rng: random.Random) -> str:
    lines = text.split("\n")
    lines.insert(rng.randrange(len(lines) + 1), rng.choice(_LINES))
    return "\n".join(lines)


def _take_line(text: str, rng: random.Random) -> str:
    others = rng.choice(SOURCES).read_text(encoding="utf-8").split("\n")
    lines = text.split("\n")
    lines.insert(rng.randrange(len(lines) + 1), rng.choice(others))
    return "\n".join(lines)


def _cut(text: str, rng: random.Random) -> str:
    start, end = sorted(rng.randrange(len(text) + 1) for _ in range(2))
    return text[:start] + text[min(end, start + 80) :]


_CHANGES: tuple[Callable[[str, random.Random], str], ...] = (
    _change_token,
    _change_token,
    _remove_token,
    _insert_token,
    _change_value,
    _change_value,
    _move_line,
    _insert_line,
    _take_line,
    _cut,
)


def changed(text: str, rng: random.Random) -> bytes:
    """Return the text of an .ini file with some random changes. A few have bytes that are not text."""
    for _ in range(rng.choice((1, 1, 2, 3, 6))):
        text = rng.choice(_CHANGES)(text, rng) or "\n"
    content = text.encode("utf-8", "surrogatepass")
    if rng.random() < 0.05:
        place = rng.randrange(len(content))
        content = content[:place] + bytes([rng.randrange(256)]) + content[place + 1 :]
    return content


def mutant(seed: int) -> tuple[Path, bytes]:
    """Return a file of the project, and its changed content. Equal seeds give equal mutants."""
    rng = random.Random(seed)
    source = rng.choice(BASES)
    return source, changed(source.read_text(encoding="utf-8"), rng)
