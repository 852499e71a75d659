"""Errors in scenarios: where they are, what is wrong, what is expected, and the nearest valid name.

`ConfigError` is what users see. Code that does not know the source of a value raises `BadValue`.
"""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from types import TracebackType
from typing import Self

_LONGEST_VALUE = 200
"""Characters of a value in a message. The corners of an outline would fill a screen."""
_LONGEST_MESSAGE = 1000
"""Characters of an error with its source."""
_LONG_QUOTE = re.compile(rf"(?<=`)[^`]{{{_LONGEST_VALUE + 1},}}(?=`)|\S{{1000,}}")
"""A part of a file in a message, or a number of a thousand digits. Names and paths are shorter."""

_MOST_ERRORS = 100
"""Errors after which reading stops."""

_SHORTEST_PART = 4
"""Characters of a name that is looked for inside of longer names."""
_SIMILAR, _TYPING_ERROR = 0.6, 0.82
"""Least ratio of difflib for similar names, and for one letter that is swapped, missing or added."""

_INDEX = re.compile(r"\[[^\]]*\]")
_WILDCARD = re.compile(r"[*?]|\{[^}]*\}")


def shortened(value: str) -> str:
    """Return a value as messages show it: only the beginning of a long one."""
    return value if len(value) <= _LONGEST_VALUE else f"{value[: _LONGEST_VALUE // 2]}…"


@dataclass(frozen=True)
class Source:
    """The place where a value of a scenario is written.

    Attributes:
        file: The .ini file, as the user named it. For an override: the file that it overrides.
        line: The line, counted from 1; 0 for an override and for the whole file.
        key: The key as it is written, or "" if the source is not that of an entry.
        value: The value as it is written.
        option: The option that gave an override, such as `--set`; "" for the lines of a file.
        part: What the value describes, if it describes several things that may be wrong, or "".
    """

    file: Path
    line: int
    key: str = ""
    value: str = ""
    option: str = ""
    part: str = ""

    @property
    def is_override(self) -> bool:
        """Whether the value comes from an option and not from a file."""
        return bool(self.option)

    def __str__(self) -> str:
        if self.is_override:
            return f"{self.option} {shortened(self.key)}={shortened(self.value)}"
        return f"{self.file}:{self.line}" if self.line else str(self.file)


class ConfigError(ValueError):
    """An error in a scenario. Its text is "FILE:LINE: problem; expected ...; did you mean `...`?".

    Attributes:
        problem: Description of the error.
        expected: What is expected, or "" if the problem says it.
        suggestion: The nearest valid name, or "".
        hint: Further advice for the end of the message, "; ...", or "".
        message: All of these, without the source.
        source: The source, or None for a mistake without one (a run number that does not exist).
        file: The file of the source, or None.
        line: The line of the source; 0 for an override, for a whole file and without a source.
        key: The key, or "".
        value: The value as it is written, or "".
    """

    def __init__(
        self,
        problem: str,
        source: Source | None = None,
        *,
        expected: str = "",
        suggestion: str = "",
        hint: str = "",
    ) -> None:
        self.problem = problem
        self.expected = expected
        self.suggestion = suggestion
        self.hint = hint
        room = _LONGEST_MESSAGE - len(f"{source}: " if source else "")
        self.message = _composed_within(room, [problem, expected, suggestion, hint])
        super().__init__(self.message, source)
        self.source = source
        self.file: Path | None = source.file if source else None
        self.line = source.line if source else 0
        self.key = source.key if source else ""
        self.value = source.value if source else ""

    @classmethod
    def at(
        cls, source: Source, problem: str, *, expected: str = "", suggestion: str = "", hint: str = ""
    ) -> Self:
        """Return an error of the value at `source`; the message shows key and value."""
        if source.key and not source.is_override:
            problem = f"{shortened(source.key)} = {shortened(source.value)}: {problem}"
        return cls(problem, source, expected=expected, suggestion=suggestion, hint=hint)

    def __str__(self) -> str:
        return f"{self.source}: {self.message}" if self.source else self.message

    def with_hint(self, hint: str) -> Self:
        """Return the same error with further advice at its end."""
        return type(self)(self.problem, self.source, **(self._details() | {"hint": self.hint + hint}))

    def _details(self) -> dict[str, str]:
        return {"expected": self.expected, "suggestion": self.suggestion, "hint": self.hint}

    def __reduce__(self) -> tuple[object, ...]:
        """For pickle, which knows no keyword arguments."""
        return _restored, (type(self), self.problem, self.source, self._details())


def _restored(
    cls: type[ConfigError], problem: str, source: Source | None, details: dict[str, str]
) -> ConfigError:
    return cls(problem, source, **details)


class ConfigErrors(ConfigError):  # noqa: N818 - several of them
    """All errors of a file, one for each entry or part of one. As a single error, it is the first.

    Of a file whose name does not end in .ini, it has the first error only. Such a file may be none of the
    user's, `include /etc/shadow`, and errors quote lines.

    Attributes:
        errors: The errors, by file and line.
    """

    def __init__(self, errors: Iterable[ConfigError]) -> None:
        """Take at least one error. Those without a source come first, then overrides, then lines."""
        unique: dict[object, ConfigError] = {}
        for error in errors:
            unique.setdefault(error.source if error.key else str(error), error)
        self.errors = list(_but_one_of_other_files(sorted(unique.values(), key=_order)))
        first = self.errors[0]
        super().__init__(first.problem, first.source, **first._details())

    def __str__(self) -> str:
        return "\n".join(map(str, self.errors))

    def __reduce__(self) -> tuple[object, ...]:
        return ConfigErrors, (self.errors,)


def _but_one_of_other_files(errors: Iterable[ConfigError]) -> Iterator[ConfigError]:
    """Yield errors, but only the first one of each file that is not an .ini file."""
    seen: set[Path] = set()
    for error in errors:
        if error.source and not error.source.is_override:
            file = _resolved(error.source.file)
            if file in seen:
                continue
            if file.suffix != ".ini":
                seen.add(file)
        yield error


def _resolved(file: Path) -> Path:
    """Return a path without symbolic links; the path itself if no file can have it."""
    try:
        return file.resolve()
    except (OSError, RuntimeError, ValueError):
        return file


def _order(error: ConfigError) -> tuple[str, int]:
    return (str(error.file or ""), error.line)


class ErrorCollector:
    """Errors that are reported together.

    Attributes:
        errors: Those found so far.
    """

    def __init__(self) -> None:
        """Start without errors."""
        self.errors: list[ConfigError] = []

    def add(self, error: ConfigError) -> None:
        """Add an error, or several. Raises ConfigErrors if there are too many: reading stops."""
        several = error.errors if isinstance(error, ConfigErrors) else [error]
        self.errors += [each for each in several if each not in self.errors]
        if len(self.errors) >= _MOST_ERRORS:
            raise ConfigErrors(self.errors)

    def collecting(self) -> Self:
        """Return a context manager that adds the ConfigError that ends its block."""
        return self

    def __enter__(self) -> None:
        pass

    def __exit__(
        self, _type: type[BaseException] | None, error: BaseException | None, _traceback: TracebackType | None
    ) -> bool:
        if not isinstance(error, ConfigError):
            return False
        self.add(error)
        return True

    def combined(self) -> ConfigError:
        """Return the errors, at least one, as one: the error itself if there is only one."""
        several = ConfigErrors(self.errors)
        return several if len(several.errors) > 1 else several.errors[0]

    def raise_all(self) -> None:
        """Raise the errors, if there are any."""
        if self.errors:
            raise self.combined()


class BadValue(ValueError):  # noqa: N818 - becomes a ConfigError where the source is known
    """A value is not of the expected kind. Its reader turns this into a ConfigError with the source.

    Attributes:
        problem: What is wrong.
        expected: What is expected, if that says more than the description of the kind.
        suggestion: The nearest valid name, or "".
        hint: More advice for the end of the message, "; ...", or "".
    """

    def __init__(self, problem: str, hint: str = "", *, expected: str = "", suggestion: str = "") -> None:
        super().__init__(_composed(problem, "", suggestion, hint))
        self.problem = problem
        self.expected = expected
        self.suggestion = suggestion
        self.hint = hint

    def with_problem(self, problem: str) -> "BadValue":
        """Return the same error with another text for what is wrong."""
        return BadValue(problem, self.hint, expected=self.expected, suggestion=self.suggestion)

    def at(self, source: Source, *, prefix: str = "", expected: str = "") -> ConfigError:
        """Return the error of the value at `source`. `expected` is used if this error has none."""
        return ConfigError.at(
            source,
            prefix + self.problem,
            expected=self.expected or expected,
            suggestion=self.suggestion,
            hint=self.hint,
        )


def _composed(problem: str, expected: str, suggestion: str, hint: str) -> str:
    text = f"{problem}; expected {expected}" if expected else problem
    return text + (f"; did you mean `{suggestion}`?" if suggestion else "") + hint


def _composed_within(room: int, parts: Iterable[str]) -> str:
    """Return the text of an error in `room` characters, if that is enough for the beginning of each part."""
    parts = [_LONG_QUOTE.sub(lambda quote: shortened(quote[0]), part) for part in parts]
    while (excess := len(_composed(*parts)) - room) > 0:
        longest = max(parts, key=len)
        if len(longest) <= _LONGEST_VALUE:
            break
        parts[parts.index(longest)] = f"{longest[: max(len(longest) - excess, _LONGEST_VALUE) - 1]}…"
    return _composed(*parts)


@dataclass(frozen=True)
class ArgumentNames:
    """What messages call the arguments of `load_scenarios`; the defaults are for scripts.

    Attributes:
        overrides: Written before KEY=VALUE.
        seed: Written before a seed.
        runs: Written before the numbers of runs.
        config: Written before the name of a configuration.
    """

    overrides: str = "override"
    seed: str = "seed ="
    runs: str = "runs ="
    config: str = "config ="


OF_SCRIPT = ArgumentNames()


def unknown_name(problem: str, name: str, known: Iterable[str]) -> ConfigError:
    """Return the error of a name that is not known. It lists the known ones, and suggests the nearest."""
    names = list(known)
    return ConfigError(problem, expected=f"one of {', '.join(names)}", suggestion=nearest(name, names))


def nearest(name: str, candidates: Iterable[str], *, strict: bool = False) -> str:
    """Return the candidate most similar to `name`, or the only one that contains it, or "".

    Case does not count, unless candidates differ in nothing else: `mw` is mW and not MW.

    Args:
        name: The name that does not exist.
        candidates: The valid names.
        strict: Accept only typing errors: one letter swapped, missing or added. Punctuation does not count.
            For names that may also be valid somewhere else.
    """
    if strict:
        by_letters = {_letters(candidate): candidate for candidate in candidates}
        matches = get_close_matches(_letters(name), by_letters, n=1, cutoff=_TYPING_ERROR)
        return by_letters[matches[0]] if matches else ""
    by_folded: dict[str, str] = {}
    for candidate in candidates:
        known = by_folded.setdefault(candidate.casefold(), candidate)
        if _equal_letters(name, candidate) > _equal_letters(name, known):
            by_folded[candidate.casefold()] = candidate
    matches = get_close_matches(name.casefold(), by_folded, n=1, cutoff=_SIMILAR)
    if not matches and len(name) >= _SHORTEST_PART:
        matches = [candidate for candidate in by_folded if name.casefold() in candidate]
    return by_folded[matches[0]] if len(matches) == 1 else ""


def _letters(name: str) -> str:
    return "".join(filter(str.isalnum, name.casefold()))


def _equal_letters(name: str, candidate: str) -> int:
    return sum(map(str.__eq__, name, candidate))


def did_you_mean(name: str, candidates: Iterable[str]) -> str:
    """Return the end of a message, "; did you mean `...`?" with the nearest candidate, or ""."""
    match = nearest(name, candidates)
    return f"; did you mean `{match}`?" if match else ""


def nearest_file(file: Path, suffixes: tuple[str, ...], written: str = "") -> str:
    """Return the most similar file name in the directory of `file`, or "".

    Names are compared without their suffix.

    Args:
        file: The file that cannot be read.
        suffixes: Suffixes of the files to suggest.
        written: `file` as the user wrote it; its directory is put before the suggested name.
    """
    directory = written.removesuffix(file.name) if written else ""
    try:
        names = sorted(sibling.name for sibling in file.parent.iterdir() if sibling.suffix in suffixes)
    except (OSError, ValueError):  # no such directory, or it is not readable
        return ""
    by_stem = {_stem(name, suffixes): name for name in names}
    match = nearest(_stem(file.name, suffixes), by_stem)
    return f"{directory}{by_stem[match]}" if match else ""


def _stem(name: str, suffixes: tuple[str, ...]) -> str:
    return next((name.removesuffix(suffix) for suffix in suffixes if name.endswith(suffix)), name)


def is_fully_qualified(key: str, parameter: str) -> bool:
    """Return whether `key` names all parts of `parameter` after its wildcards. Indices do not count.

    `**.power` does not: it matches transmitters and the background noise. Messages then name the parameter.

    Args:
        key: A key of a file.
        parameter: The path below a node or a part of the network, such as "mobility.speed".
    """
    return _WILDCARD.split(_INDEX.sub("", key))[-1].endswith(f".{_INDEX.sub('', parameter)}")
