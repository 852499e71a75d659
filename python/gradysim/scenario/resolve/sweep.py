"""Parameter sweeps: iteration variables `${x=1, 2, 5}`, their combinations, and `${...}` replaced run by run.

The grammar is OMNeT++'s: a configuration with iteration variables stands for the runs of all combinations of
their values. `name_iterations` gives each variable a name and leaves `${NAME}` in its place; a variable
without a name is called by its number: 0, 1, 2 and so on. `substitute` replaces names by values.
"""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal, InvalidOperation, Overflow
from functools import cached_property
from itertools import chain
from pathlib import Path

from gradysim.scenario.errors import BadValue, ConfigError, ErrorCollector, Source, nearest
from gradysim.scenario.parse.functions import is_quoted, unquoted
from gradysim.scenario.parse.ini import Entry
from gradysim.scenario.schema.options import OPTIONS, is_ignored
from gradysim.scenario.schema.values import read_scalar

REPETITION = "repetition"
"""The variable that counts the runs of one combination of values, from 0."""

PREDEFINED = (
    "runnumber",
    REPETITION,
    "configname",
    "iterationvars",
    "iterationvarsf",
    "iterationvarsd",
    "seedset",
    "experiment",
    "measurement",
    "replication",
    "inifile",
    "network",
)
"""Variables that every run has: those of OMNeT++ that are the same when a run is repeated."""

MAX_VALUES = 1_000_000
"""Most values of one variable, and most runs of a configuration."""

LABELS = {"experiment": "configname", "measurement": "iterationvars", "replication": REPETITION}
"""{variable: its default, unless the option `experiment-label` and so on sets it}."""

LABEL_OPTIONS = tuple(f"{name}-label" for name in LABELS)

OF_ALL_VALUES = {"iterationvars", "iterationvarsf", "iterationvarsd"}
"""Variables that have the values of all iteration variables."""

_SAME_IN_ALL_RUNS = ("configname", "inifile", "network")
_HIDDEN_IN_HASH = {name: f"${{{name}}}" for name in ("runnumber", REPETITION, "seedset", "inifile")}
"""Placeholders for variables in a settings hash: runs that differ only in these have the same settings."""

MOST_CHARACTERS = 2**24
"""Limit for all values of a configuration, and for a value after the replacement of its variables."""

_MOST_VARIABLES = 1000
"""Largest number of variables of a configuration."""

_MOST_DIGITS = 300
"""Largest number of digits in a range, whose numbers are written without exponents."""

_NAME = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_DEFINITION = re.compile(r"\s*([A-Za-z_]\w*)\s*=(?!=)(.*)", re.ASCII | re.DOTALL)
_LOCK_STEP = re.compile(r"(.*)!\s*([A-Za-z_]\w*)\s*", re.ASCII | re.DOTALL)
_INSIDE = re.compile(r"(?:[^\\}$]++|\\.|\$(?!\{))*+", re.DOTALL)
_PIECE = re.compile(r'\\.|[^\\",()\[\]{}]+|.', re.DOTALL)
"""Of a list of values: what a backslash protects, plain text, or a character with a meaning."""
_NUMBER = r"[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d+)?"
_RANGE = re.compile(rf"({_NUMBER})\s*\.\.\s*({_NUMBER})(?:\s+step\s+({_NUMBER}))?", re.ASCII)
_LIKE_A_RANGE = re.compile(r"[-+]?\.?\d[^\"']*\.\.", re.ASCII)
_VARIABLE = re.compile(r"\$\{([^{}]*)\}")
_NOT_IN_FILE_NAMES = re.compile(r"[^\w!()\[\];=+@~.#,-]", re.ASCII)


@dataclass(frozen=True)
class IterationVariable:
    """One variable with its values.

    Attributes:
        name: Name in the file, or a number.
        values: Strings that replace it, in order.
        source: Where it is defined.
        follows: Name of the variable that it is in lock-step with, or "".
    """

    name: str
    values: tuple[str, ...]
    source: Source
    follows: str = ""

    @cached_property
    def size(self) -> int:
        """The characters of all values."""
        return sum(map(len, self.values))


def name_iterations(entries: Iterable[Entry]) -> tuple[list[Entry], list[IterationVariable]]:
    """Return the entries with `${NAME}` for each variable, and the variables in search order.

    If an earlier entry has the same key, word for word, an entry is never in force: it is left out. So are
    its variables, unless another entry reads them. An override thus fixes what the file iterates over.

    Raises:
        ConfigError: Variables are not understood, or defined twice; all of them are reported.
    """
    named: list[Entry] = []
    variables: dict[str, IterationVariable] = {}
    errors = ErrorCollector()
    first: dict[str, Entry] = {}
    swept = [(entry, first.setdefault(entry.key, entry) is entry) for entry in entries]
    wanted = _read_elsewhere(first.values())
    for entry, in_force in swept:
        if "${" not in entry.text or is_ignored(entry):
            named.append(entry)
        elif in_force or wanted.intersection(_names_in(entry)[0]):
            with errors.collecting():
                with_names = _with_names(entry, variables)
                wanted.difference_update(variables)
                if in_force:
                    named.append(with_names)
    if not errors.errors:  # the names of variables that are not understood would be unknown
        _check_names(named, variables, errors)
    errors.raise_all()
    return named, list(variables.values())


def _read_elsewhere(entries: Iterable[Entry]) -> set[str]:
    """Return the names that entries read, and that none of them defines."""
    defined, read = set[str](), set[str]()
    for entry in entries:
        if "${" in entry.text and not is_ignored(entry):
            for names, found in zip((defined, read), _names_in(entry), strict=True):
                names.update(found)
    return read - defined


def _names_in(entry: Entry) -> tuple[set[str], set[str]]:
    """Return the names that an entry defines, and those that it reads."""
    defined, read = set[str](), set[str]()
    for content in _VARIABLE.findall(entry.text):
        if definition := _DEFINITION.fullmatch(content):
            defined.add(definition[1])
        leader = _LOCK_STEP.fullmatch(content)
        read.add(leader[2] if leader else content.strip())
    return defined, read


def _with_names(entry: Entry, variables: dict[str, IterationVariable]) -> Entry:
    """The entry with the name of each variable in its place. Adds the variables that it defines."""
    text, start = "", 0
    while (at := entry.text.find("${", start)) >= 0:
        end = _closing_brace(entry, at + 2)
        content = entry.text[at + 2 : end].strip()
        name = content if _NAME.fullmatch(content) else _define(content, entry, variables)
        text += f"{entry.text[start:at]}${{{name}}}"
        start = end + 1
    return replace(entry, text=text + entry.text[start:])


def _closing_brace(entry: Entry, start: int) -> int:
    inside = _INSIDE.match(entry.text, start)
    end = inside.end() if inside else start
    if entry.text.startswith("${", end):
        raise ConfigError.at(entry.source, "a variable stands inside of another one; expected none there")
    if not entry.text.startswith("}", end):
        raise ConfigError.at(entry.source, "`${` is not closed; expected a `}`")
    return end


def _define(content: str, entry: Entry, variables: dict[str, IterationVariable]) -> str:
    name, follows, listed = "", "", content
    if match := _DEFINITION.fullmatch(listed):
        name, listed = match[1], match[2]
    if match := _LOCK_STEP.fullmatch(listed):
        listed, follows = match[1], match[2]
    if name in PREDEFINED:
        raise ConfigError.at(entry.source, f"`${{{name}}}` is there in every run; expected another name")
    if name in variables:
        other = variables[name].source
        where = f"line {other.line}" if other.line and other.file == entry.source.file else str(other)
        raise ConfigError.at(
            entry.source, f"`{name}` has its values at {where} already; expected `${{{name}}}` here"
        )
    if len(variables) == _MOST_VARIABLES:
        raise ConfigError.at(entry.source, f"more than {_MOST_VARIABLES} variables; expected fewer")
    name = name or str(sum(variable.isdigit() for variable in variables))
    room = MOST_CHARACTERS - sum(variable.size for variable in variables.values())
    every = chain.from_iterable(_values(part, entry) for part in _split(listed))
    values = tuple(_bounded(every, room, entry))
    variables[name] = IterationVariable(name, values, entry.source, follows)
    return name


def _bounded(values: Iterable[str], room: int, entry: Entry) -> Iterator[str]:
    """Yield values. Raises ConfigError for more than `MAX_VALUES`, and for more than `room` characters."""
    for count, value in enumerate(values):
        room -= len(value)
        if room < 0:
            problem = f"the values of all `${{...}}` have more than {MOST_CHARACTERS} characters"
            raise ConfigError.at(entry.source, f"{problem}; expected fewer")
        if count == MAX_VALUES:
            problem = f"`${{...}}` has too many values; expected at most {MAX_VALUES}"
            raise ConfigError.at(entry.source, problem)
        yield value


def _split(listed: str) -> list[str]:
    """Split at commas, but not at those in quotes, in parentheses, or behind a backslash."""
    parts: list[list[str]] = [[]]
    depth, quoted = 0, False
    for piece in _PIECE.findall(listed):
        if not quoted and depth <= 0 and piece == ",":
            parts.append([])
            continue
        quoted ^= piece == '"'
        if not quoted:
            depth += (piece in "([{") - (piece in ")]}")
        parts[-1].append(piece[1] if piece in (r"\,", r"\}") else piece)
    return ["".join(part).strip() for part in parts]


def _values(part: str, entry: Entry) -> Iterator[str]:
    if match := _RANGE.fullmatch(part):
        try:
            yield from _values_of_range(part, match[1], match[2], match[3] or "1")
        except BadValue as error:
            raise ConfigError.at(entry.source, str(error)) from None
        return
    problem = ""
    if not part:
        problem = "a value of `${...}` is empty; expected a list such as `${x=1, 2, 5}`"
    elif _LIKE_A_RANGE.match(part):
        numbers = "expected plain numbers, and the unit behind the brace: `${10..60 step 10}m`"
        problem = f"`{part}` is not a range; {numbers}"
    if problem:
        raise ConfigError.at(entry.source, problem)
    yield part


def _values_of_range(part: str, *numbers: str) -> Iterator[str]:
    try:
        first, last, step = map(Decimal, numbers)
        if any(abs(number.adjusted()) > _MOST_DIGITS for number in (first, last, step)):
            raise Overflow
        count = (last - first) / step if step else Decimal(-1)
    except (InvalidOperation, Overflow):  # an exponent beyond all bounds
        expected = f"expected numbers of at most {_MOST_DIGITS} digits"
        raise BadValue(f"`{part}` is out of range; {expected}") from None
    if count < 0:
        raise BadValue(f"`{part}` has no values; expected a step that leads from the first to the last")
    if count >= MAX_VALUES:
        raise BadValue(f"`{part}` has too many values; expected at most {MAX_VALUES}")
    for index in range(int(count) + 1):
        text = f"{first + index * step:f}"
        yield text.rstrip("0").rstrip(".") if "." in text else text


def _check_names(
    named: Iterable[Entry],
    variables: Mapping[str, IterationVariable],
    errors: ErrorCollector,
) -> None:
    """Report names that are not variables."""
    known = [*(name for name in variables if not name.isdigit()), *PREDEFINED]
    for entry in named:
        for name in [] if is_ignored(entry) else _VARIABLE.findall(entry.text):
            if name not in variables and name not in PREDEFINED:
                errors.add(_unknown(entry.source, name, known))
    for variable in variables.values():
        leader = variable.follows
        if leader in PREDEFINED and leader != REPETITION:
            expected = f"expected `{REPETITION}` or one that has"
            problem = f"`{leader}` has no list of values; {expected}"
            errors.add(ConfigError.at(variable.source, problem))
        elif leader and leader not in (*variables, REPETITION):
            errors.add(_unknown(variable.source, leader, known))


def _unknown(source: Source, name: str, known: Sequence[str]) -> ConfigError:
    listed = ", ".join(f"`${{{other}}}`" for other in known)
    expected = f"one of {listed}, or values such as `${{{name}=1, 2, 5}}`"
    problem = f"there is no variable `{name}`"
    return ConfigError.at(source, problem, expected=expected, suggestion=nearest(name, known))


def text_of_iterations(values: Mapping[str, object]) -> str:
    """Write a combination as OMNeT++ does: `$x=1, $speed=5`."""
    return ", ".join(f"${name}={value}" for name, value in values.items())


def file_names_of_iterations(values: Mapping[str, str]) -> tuple[str, str]:
    """Write a combination as OMNeT++ does for files, `x=1,speed=5-`, and for folders, `x=1/speed=5`."""
    parts = [
        f"{'' if name.isdigit() else f'{name}='}{_for_file_name(value)}" for name, value in values.items()
    ]
    return f"{','.join(parts)}-" if parts else "", "/".join(parts)


def _for_file_name(value: str) -> str:
    """A string without its quotes and without spaces, and a code for what some systems do not allow."""
    if is_quoted(value):
        value = unquoted(value)
    return _NOT_IN_FILE_NAMES.sub(
        lambda match: "".join(f"#{byte:02x}" for byte in match[0].encode(errors="surrogateescape")),
        value.replace(" ", "_"),
    )


def run_variables(
    file: Path, network: str, config: str, run_number: int, repetition: int, iterations: Mapping[str, str]
) -> dict[str, str]:
    """Return the variables of one run, without those that depend on seeds and labels: see `with_labels`."""
    in_one_name, in_folders = file_names_of_iterations(iterations)
    return {
        **iterations,
        "inifile": str(file),
        "network": network,
        "configname": config,
        "runnumber": str(run_number),
        REPETITION: str(repetition),
        "iterationvars": text_of_iterations(iterations),
        "iterationvarsf": in_one_name,
        "iterationvarsd": in_folders,
    }


def with_labels(
    variables: Mapping[str, str], seed: int, options: Mapping[str, Entry], *, for_hash: bool = False
) -> dict[str, str]:
    """Return the variables of one run with its seed and labels. A label may name those before it.

    In `options` no variable has been replaced yet. `for_hash` puts placeholders instead of numbers of
    the run, and leaves labels as they are written, since expressions cannot be evaluated with placeholders.

    Raises ConfigError for a label that is not a string, or that depends on itself.
    """
    known = {**variables, **_HIDDEN_IN_HASH} if for_hash else {**variables, "seedset": str(seed)}
    for (name, default), option in zip(LABELS.items(), LABEL_OPTIONS, strict=True):
        entry = options.get(option)
        if entry is None:
            known[name] = f"{'#' if default == REPETITION else ''}{known[default]}"
        else:
            label = substitute(entry, known)
            known[name] = label.text if for_hash else free_text(label)
    return known


def free_text(entry: Entry) -> str:
    """Return the string of an option that needs no quotes, as in OMNeT++."""
    return str(read_scalar(entry, OPTIONS[entry.key])) if entry.text.startswith('"') else entry.text


def is_free_text_in_all_runs(entry: Entry, variables: Iterable[IterationVariable]) -> bool:
    """Return whether an option that needs no quotes is valid in all runs if it is in the first one.

    It is if it is one string and no value can end that, since no value has a quote or a backslash.
    """
    names = variables_in(entry.text)
    if names & LABELS.keys() or (entry.text.startswith('"') and not is_quoted(entry.text)):
        return False
    used = [each for each in variables if each.name in names or names & OF_ALL_VALUES]
    longest = sum(len(each.name) + max(map(len, each.values)) + len(", $=") for each in used)
    return longest * len(_VARIABLE.findall(entry.text)) + len(entry.text) <= MOST_CHARACTERS and not any(
        character in "".join(each.values) for each in used for character in '"\\'
    )


def substitute(entry: Entry, variables: Mapping[str, str]) -> Entry:
    """Return the entry with its variables replaced by their values, also inside of strings.

    Raises ConfigError for a variable that depends on this entry, and if the result is too long.
    """
    if "${" not in entry.text:
        return entry
    room = MOST_CHARACTERS

    def value(match: re.Match[str]) -> str:
        nonlocal room
        if match[1] not in variables:
            raise ConfigError.at(
                entry.source, f"`${{{match[1]}}}` follows from this value; expected one that does without it"
            )
        room -= len(variables[match[1]])
        if room < 0:
            problem = f"with its variables replaced it has more than {MOST_CHARACTERS} characters"
            raise ConfigError.at(entry.source, f"{problem}; expected fewer")
        return variables[match[1]]

    return replace(entry, text=_VARIABLE.sub(value, entry.text))


def substituted(entries: Iterable[Entry], variables: Mapping[str, str]) -> list[Entry]:
    """Return the entries with their variables replaced, except in OMNeT++'s own entries."""
    return [entry if is_ignored(entry) else substitute(entry, variables) for entry in entries]


def variables_in(text: str) -> set[str]:
    """Return the names of the variables in a value."""
    return set(_VARIABLE.findall(text))


def depends_on_run(entry: Entry) -> bool:
    """Whether the value differs between the runs of a configuration."""
    return any(match[1] not in _SAME_IN_ALL_RUNS for match in _VARIABLE.finditer(entry.text))
