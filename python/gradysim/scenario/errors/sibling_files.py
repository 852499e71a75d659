"""The files beside one that cannot be read: for messages that ask whether one of them was meant."""

from pathlib import Path

from gradysim.scenario.errors.nearest import nearest


def file_meant(file: Path, suffixes: tuple[str, ...], name: str = "") -> str:
    """The end of a message, "; did you mean ...?" with the nearest name beside `file`; "" if there is none.

    Files are like each other by what their names have before the suffix. In the message stands the folder as
    it does in `name`, which is how the user called the file: its bare name by default.
    """
    written = name or file.name
    folder = written[: len(written) - len(file.name)]
    match = nearest(_stem(file.name, suffixes), (found := _beside(file, suffixes)))
    return f"; did you mean `{folder}{found[match]}`?" if match is not None else ""


def _beside(file: Path, suffixes: tuple[str, ...]) -> dict[str, str]:
    """{stem: name} of the files in its folder; none if there is no such folder, or it is a secret."""
    try:
        names = sorted(sibling.name for sibling in file.parent.iterdir() if sibling.suffix in suffixes)
    except (OSError, ValueError):
        return {}
    return {_stem(name, suffixes): name for name in names}


def _stem(name: str, suffixes: tuple[str, ...]) -> str:
    return next((name.removesuffix(suffix) for suffix in suffixes if name.endswith(suffix)), name)
