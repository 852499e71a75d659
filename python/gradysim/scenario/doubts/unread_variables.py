"""Studies of what nothing reads: `**.rtsThreshold = ${rts=3000B, 100B}`, overridden by another key.

The runs of such values are alike, and their results say that they are not. An override with the very same key
makes no such runs; that another key says the same shows only when all runs are known.
"""

from collections.abc import Iterable, Iterator, Sequence

from gradysim.scenario.doubts.shadowed_lines import line_that_says_it_instead
from gradysim.scenario.errors import Source
from gradysim.scenario.file.reader import Entry
from gradysim.scenario.runs.unread_variables import UnreadVariables


def unread_variables(unread: Iterable[UnreadVariables], lines: Sequence[Entry]) -> Iterator[str]:
    """Yield one line of text for each line with such variables, "FILE:LINE: warning: ...".

    `lines` are those of the configuration, in the order of the search.
    """
    for each in unread:
        line, variables = each.source, " and ".join(f"${name}" for name in each.names)
        instead = each.instead or _same_in_other_words(line, lines)
        yield (
            f"{line}: warning: no run reads `{line.key}`, and runs that differ in {variables} alone are"
            f" alike{_why(instead, line)}"
        )


def _same_in_other_words(line: Source, lines: Sequence[Entry]) -> Source | None:
    place = [entry.source for entry in lines].index(line)
    instead = line_that_says_it_instead(lines[place], lines[:place])
    return instead.source if instead else None


def _why(instead: Source | None, line: Source) -> str:
    if instead is None:
        return "; expected a line that some run reads"
    is_near = instead.file == line.file and not instead.is_override
    place = f"line {instead.line}, `{instead.key}`," if is_near else f"`{instead}`"
    return f": {place} is in force; expected an override with the very same key, which makes no such runs"
