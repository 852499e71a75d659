"""Declarations of the numbers of a run: each field of a result once, for all outputs.

A field of `RunResult` or `NodeResult` is annotated with a `Quantity`, as is the value of a cached property.
The JSON object, the scalars of `.sca` files, the summary, `gradysim means` and the reference table of
docs/reference/results.md follow from it.
"""

import dataclasses
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from functools import cached_property
from typing import Any, NamedTuple, get_args

from gradysim.protocol.plain_value import plain_value

Names = str | Iterable[str]
"""One name or several, with `*` for any characters and `?` for a single one."""


@dataclass(frozen=True)
class Scalar:
    """One number in a `.sca` file.

    Attributes:
        module: Full path, which starts with the name of the network.
    """

    module: str
    name: str
    value: float
    attributes: Mapping[str, str] = field(default_factory=dict)


class Average(NamedTuple):
    """One number of a run that `gradysim means` averages over runs.

    Attributes:
        name: As in its column `quantity`.
        shown_at_zero: Whether it also has a row if it is 0 in all runs.
        listed: Whether it has a row without a request by name.
    """

    name: str
    value: float
    shown_at_zero: bool = True
    listed: bool = True


@dataclass(frozen=True)
class Quantity:
    """Declaration of one field of a result.

    A number needs names only. A family (a mapping of any size) has functions that make scalars and averages
    of its value.

    Attributes:
        text: Description for the reference table, in Markdown.
        unit: Unit of a number, in scalars and in the summary; "" for none.
        scalar: Name in `.sca` files; for a family the pattern of its names. "" to leave it out.
        summary: Label in the summary; "" to leave it out.
        digits: Format specification of the number in the summary.
        mean: Name in `gradysim means`; for a family the pattern of its names. "" if it is not averaged.
        in_json: Whether the JSON object has it.
        omitted: Values that the JSON object leaves out.
        to_json: Converts the value to plain values.
        scalars: For a family, (value, module) to scalars.
        averages: For a family, plain value to averages.
    """

    text: str
    unit: str = ""
    scalar: str = ""
    summary: str = ""
    digits: str = ""
    mean: str = ""
    in_json: bool = True
    omitted: tuple[object, ...] = ()
    to_json: Callable[[Any], object] = plain_value
    scalars: Callable[[Any, str], Iterator[Scalar]] | None = None
    averages: Callable[[Any], Iterator[Average]] | None = None


def quantities(result: type[Any]) -> Mapping[str, Quantity]:
    """Return {name: its declaration} of the fields of a result class, then of what follows from them."""
    if result not in _known:
        types = {each.name: each.type for each in dataclasses.fields(result)}
        for name, member in vars(result).items():
            if isinstance(member, cached_property):
                types[name] = member.func.__annotations__["return"]
        _known[result] = {name: get_args(each)[1] for name, each in types.items()}
    return _known[result]


_known: dict[type, Mapping[str, Quantity]] = {}


def json_object(result: Any, names: Iterable[str] = ()) -> dict[str, object]:
    """Return the fields of a result, or only those of `names`, as plain dicts, lists and numbers."""
    plain = {}
    declared = quantities(type(result))
    for name in names or declared:
        value, quantity = getattr(result, name), declared[name]
        if quantity.in_json and value not in quantity.omitted:
            plain[name] = quantity.to_json(value)
    return plain


def scalars_of(result: Any, module: str) -> Iterator[Scalar]:
    """Yield the scalars of all fields of a result; the paths of their modules start with `module`."""
    for name, quantity in quantities(type(result)).items():
        value = getattr(result, name)
        if value is None:
            continue
        if quantity.scalars is not None:
            yield from quantity.scalars(value, module)
        elif quantity.scalar:
            yield recorded(module, quantity.scalar, value, quantity.unit)


def averages_of(result_type: type, plain: Mapping[str, Any]) -> Iterator[Average]:
    """Yield the numbers of a run in a JSON object, which may be of an older version.

    Numbers without a name in `gradysim means` have the name of their field, such as `cpu_s`.
    """
    for name, quantity in quantities(result_type).items():
        value = plain.get(name)
        if quantity.averages is not None:
            yield from quantity.averages(value or {})
        elif value is not None and (quantity.mean or (quantity.scalar and quantity.scalars is None)):
            yield Average(quantity.mean or name, value, listed=bool(quantity.mean))


def recorded(module: str, name: str, value: float, unit: str = "") -> Scalar:
    """Return a scalar; `heard:last` means that its source is `heard` and its recording mode `last`."""
    source, _, mode = name.rpartition(":")
    attributes = {"unit": unit} if unit else {}
    if source:
        attributes |= {"source": source, "recordingmode": mode}
    return Scalar(module, name, value, attributes)


def name_filter(names: Names | None) -> Callable[[str], bool]:
    """Return a function that checks whether a name matches one of the patterns; None matches all names."""
    if names is None:
        return lambda _: True
    # Brackets are literal, as in `received[0]:last`.
    patterns = [name.replace("[", "[[]") for name in ([names] if isinstance(names, str) else names)]
    return lambda name: any(fnmatchcase(name, pattern) for pattern in patterns)
