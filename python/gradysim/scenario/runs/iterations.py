"""Iteration variables: `${10ms, 50ms}`, `${x=1, 2, 5}`, `${0..10 step 2}`, in lock-step `${a, b, c ! x}`.

The grammar is OMNeT++'s, where a configuration with such variables stands for the runs of all their
combinations. This stage gives each variable a name and leaves `${NAME}` in its place, so that the one after
it, `variables`, has only names to replace. One without a name is called by its number: 0, 1, 2 and so on.
"""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal, InvalidOperation, Overflow

from gradysim.scenario.distributions import distribution_in
from gradysim.scenario.errors.config_error import ConfigError
from gradysim.scenario.errors.nearest import did_you_mean
from gradysim.scenario.errors.source import Source
from gradysim.scenario.file.reader import Entry
from gradysim.scenario.file.sections import Ranked
from gradysim.scenario.functions import is_quoted, unquoted
from gradysim.scenario.matching.lookup import is_ignored

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
"""Variables that every run has, whatever its file says: those of OMNeT++ that are the same when a run is done
again."""

MAX_VALUES = 1_000_000
"""Of one variable; also the most runs of a configuration."""

_MOST_DIGITS = 300
"""Of the numbers of a range, which are written without exponents."""

_NAME = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_DEFINITION = re.compile(r"\s*([A-Za-z_]\w*)\s*=(?!=)(.*)", re.ASCII | re.DOTALL)
_LOCK_STEP = re.compile(r"(.*)!\s*([A-Za-z_]\w*)\s*", re.ASCII | re.DOTALL)
_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_RANGE = re.compile(rf"({_NUMBER})\s*\.\.\s*({_NUMBER})(?:\s+step\s+({_NUMBER}))?", re.ASCII)
_NOT_IN_FILE_NAMES = re.compile(r"[^\w!()\[\];=+@~.#,-]", re.ASCII)
_LIKE_A_RANGE = re.compile(r"[-+]?\.?\d[^\"']*\.\.", re.ASCII)


@dataclass(frozen=True)
class IterationVariable:
    """One variable with the values that it takes.

    Attributes:
        name: As the file says, or a number.
        values: Texts that take its place, in their order.
        source: Where it stands.
        follows: Name of the variable that it is in lock-step with, or "".
    """

    name: str
    values: tuple[str, ...]
    source: Source
    follows: str = ""


def name_iterations(
    ranked: Iterable[Ranked],
) -> tuple[list[Ranked], list[IterationVariable]]:
    """Return the entries with `${NAME}` for each variable, and the variables in the order of the search.

    An entry whose key another one before it says, word for word, is never in force: it is left out, and so
    are its variables. An override thus fixes what the file iterates over.

    Raises:
        ConfigError: A variable is not understood, or defined twice.
    """
    named: list[Ranked] = []
    left_out: list[Entry] = []
    variables: dict[str, IterationVariable] = {}
    seen: set[str] = set()
    for rank, entry in ranked:
        if "${" not in entry.text or is_ignored(entry):
            named.append(Ranked(rank, entry))
        elif entry.key not in seen:
            named.append(Ranked(rank, _with_names(entry, variables)))
        else:
            left_out.append(entry)
        seen.add(entry.key)
    _check_names(named, variables, left_out)
    return named, list(variables.values())


def combinations(variables: Sequence[IterationVariable]) -> Iterator[dict[str, str]]:
    """Give all combinations of values by name; the last variable changes fastest."""
    by_name = {variable.name: variable for variable in variables}
    free = [variable for variable in variables if not variable.follows]

    def places(rest: Sequence[IterationVariable]) -> Iterator[dict[str, int]]:
        if not rest:
            yield {}
            return
        for place in range(len(rest[0].values)):
            for others in places(rest[1:]):
                yield {rest[0].name: place, **others}

    for chosen in places(free):
        yield {
            variable.name: variable.values[chosen[_leader(variable, by_name).name]] for variable in variables
        }


def count_combinations(variables: Sequence[IterationVariable]) -> int:
    """How many combinations there are, without making them.

    Raises:
        ConfigError: There are too many.
    """
    count = 1
    for variable in variables:
        count *= 1 if variable.follows else len(variable.values)
        if count > MAX_VALUES:
            raise ConfigError.at(
                variable.source, f"more than {MAX_VALUES} combinations of values; expected fewer"
            )
    return count


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
    """The value, but a text without its quotes, no spaces, and a code for what some system does not take."""
    if is_quoted(value):
        value = unquoted(value)
    return _NOT_IN_FILE_NAMES.sub(
        lambda match: "".join(f"#{byte:02x}" for byte in match[0].encode(errors="surrogateescape")),
        value.replace(" ", "_"),
    )


def _with_names(entry: Entry, variables: dict[str, IterationVariable]) -> Entry:
    """The entry with the name of each variable in its place; those that it defines are added."""
    text, start = "", 0
    while (at := entry.text.find("${", start)) >= 0:
        end = _closing_brace(entry, at + 2)
        content = entry.text[at + 2 : end].strip()
        name = content if _NAME.fullmatch(content) else _define(content, entry, variables)
        text += f"{entry.text[start:at]}${{{name}}}"
        start = end + 1
    return replace(entry, text=text + entry.text[start:])


def _closing_brace(entry: Entry, start: int) -> int:
    end = start
    while end < len(entry.text) and entry.text[end] != "}":
        if entry.text.startswith("${", end):
            raise ConfigError.at(entry.source, "a variable stands inside of another one; expected none there")
        end += 2 if entry.text[end] == "\\" else 1
    if end >= len(entry.text):
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
        place = f"line {other.line}" if other.line and other.file == entry.source.file else str(other)
        raise ConfigError.at(
            entry.source, f"`{name}` has its values at {place} already; expected `${{{name}}}` here"
        )
    name = name or str(sum(variable.isdigit() for variable in variables))
    values = tuple(value for part in _split(listed) for value in _values(part, entry))
    variables[name] = IterationVariable(name, values, entry.source, follows)
    return name


def _split(listed: str) -> list[str]:
    """The parts between commas, but for those in quotes, in parentheses, or behind a backslash."""
    parts, part, depth, quoted, position = [], "", 0, False, 0
    while position < len(listed):
        character = listed[position]
        if character == "\\" and listed[position + 1 : position + 2] in (",", "}"):
            position += 1
            part += listed[position]
        elif character == "\\" and quoted:
            part += listed[position : position + 2]
            position += 1
        elif character == "," and depth <= 0 and not quoted:
            parts.append(part.strip())
            part = ""
        else:
            quoted ^= character == '"'
            depth += 0 if quoted else (character in "([{") - (character in ")]}")
            part += character
        position += 1
    return [*parts, part.strip()]


def _values(part: str, entry: Entry) -> Iterator[str]:
    if not part:
        raise ConfigError.at(
            entry.source, "a value of `${...}` is empty; expected a list such as `${x=1, 2, 5}`"
        )
    match = _RANGE.fullmatch(part)
    if match is None:
        if _LIKE_A_RANGE.match(part):
            raise ConfigError.at(
                entry.source,
                f"`{part}` is no range; expected plain numbers, and the unit behind the brace:"
                " `${10..60 step 10}m`",
            )
        if function := distribution_in(part):
            raise ConfigError.at(
                entry.source,
                f"`{function}` draws the value of one parameter, and a value of `${{...}}` is for a whole"
                " run; expected the variable inside of the function: `uniform(0s, ${1, 5}s)`",
            )
        yield part
        return
    try:
        first, last, step = numbers = [Decimal(text) for text in (match[1], match[2], match[3] or "1")]
        if any(abs(number.adjusted()) > _MOST_DIGITS for number in numbers):
            raise Overflow
        count = (last - first) / step if step else Decimal(-1)
    except (InvalidOperation, Overflow):  # an exponent beyond all bounds
        text = f"`{part}` is out of range; expected numbers of at most {_MOST_DIGITS} digits"
        raise ConfigError.at(entry.source, text) from None
    if count < 0:
        raise ConfigError.at(
            entry.source, f"`{part}` has no values; expected a step that leads from the first to the last"
        )
    if count >= MAX_VALUES:
        raise ConfigError.at(entry.source, f"`{part}` has too many values; expected at most {MAX_VALUES}")
    for index in range(int(count) + 1):
        yield _plain(first + index * step)


def _plain(number: Decimal) -> str:
    """The number without an exponent and without zeros at its end."""
    text = f"{number:f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def _check_names(
    named: Iterable[Ranked],
    variables: Mapping[str, IterationVariable],
    left_out: Sequence[Entry],
) -> None:
    """Raise ConfigError for a name that is no variable."""
    known = [*(name for name in variables if not name.isdigit()), *PREDEFINED]
    for _, entry in named:
        if is_ignored(entry):
            continue
        for match in re.finditer(r"\$\{([^{}]*)\}", entry.text):
            if match[1] not in (*variables, *PREDEFINED):
                raise ConfigError.at(entry.source, _unknown(match[1], known, left_out))
    for variable in variables.values():
        if variable.follows in PREDEFINED and variable.follows != REPETITION:
            raise ConfigError.at(
                variable.source,
                f"`{variable.follows}` has no list of values; expected `{REPETITION}` or one that has",
            )
        if variable.follows and variable.follows not in (*variables, REPETITION):
            raise ConfigError.at(variable.source, _unknown(variable.follows, known, left_out))


def check_lock_step(variables: Sequence[IterationVariable]) -> None:
    """Raise ConfigError for a lock-step in a circle, or of variables with different numbers of values."""
    by_name = {variable.name: variable for variable in variables}
    for variable in variables:
        leader = _leader(variable, by_name)
        if len(leader.values) != len(variable.values):
            raise ConfigError.at(
                variable.source,
                f"it has {len(variable.values)} values and is in lock-step with `{leader.name}`, which has"
                f" {len(leader.values)}; expected as many",
            )


def _unknown(name: str, known: Sequence[str], left_out: Sequence[Entry]) -> str:
    for entry in left_out:
        if re.search(rf"\$\{{\s*{name}\s*=", entry.text):
            return (
                f"`{name}` has its values at {entry.source}, which another value of `{entry.key}` overrides;"
                f" expected a value here that does without it, or `${{{name}=...}}` there"
            )
    listed = ", ".join(f"`${{{other}}}`" for other in known)
    return (
        f"there is no variable `{name}`; expected one of {listed}, or values such as `${{{name}=1, 2, 5}}`"
        f"{did_you_mean(name, known)}"
    )


def _leader(variable: IterationVariable, by_name: Mapping[str, IterationVariable]) -> IterationVariable:
    """The variable that this one is in lock-step with in the end; itself if it is in none."""
    passed = [variable.name]
    while variable.follows:
        if variable.follows in passed:
            raise ConfigError.at(
                variable.source, f"`{variable.follows}` is in lock-step with itself; expected no circle"
            )
        variable = by_name[variable.follows]
        passed.append(variable.name)
    return variable
