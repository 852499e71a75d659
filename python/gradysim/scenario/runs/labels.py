"""What results of a run are found by: seed, and labels of experiment, measurement and replication.

They are variables of a run, too, which the values of all other keys may name. Each may name those before it.
"""

from collections.abc import Mapping

from gradysim.scenario.file.reader import Entry
from gradysim.scenario.options import OPTIONS
from gradysim.scenario.runs.variables import substitute
from gradysim.scenario.settings import read_scalar

LABELS = {"experiment": "configname", "measurement": "iterationvars", "replication": "repetition"}
"""{variable: what it is unless the option `experiment-label` and so on says otherwise}."""

LABEL_OPTIONS = tuple(f"{name}-label" for name in LABELS)

_UNTOLD = {name: f"${{{name}}}" for name in ("runnumber", "repetition", "seedset", "inifile")}
"""What stands for variables in a hash: runs that differ in these alone are of the same settings."""


def with_labels(
    variables: Mapping[str, str], seed: int, options: Mapping[str, Entry], *, for_hash: bool = False
) -> dict[str, str]:
    """The variables of one run with its seed and its labels; in `options` no variable has been replaced yet.

    `for_hash`: with placeholders for its numbers, in labels, too. These are as they are written then, since
    an expression cannot be worked out with them.

    Raises ConfigError for a label that is no text, or that depends on itself.
    """
    known = {**variables, **_UNTOLD} if for_hash else {**variables, "seedset": str(seed)}
    for (name, default), option in zip(LABELS.items(), LABEL_OPTIONS, strict=True):
        number_sign = "#" if default == "repetition" else ""
        entry = options.get(option)
        if entry is None:
            known[name] = f"{number_sign}{known[default]}"
        else:
            label = substitute(entry, known)
            known[name] = label.text if for_hash else free_text(label)
    return known


def free_text(entry: Entry) -> str:
    """The text of an option that needs no quotes, as in OMNeT++."""
    return str(read_scalar(entry, OPTIONS[entry.key])) if entry.text.startswith('"') else entry.text
