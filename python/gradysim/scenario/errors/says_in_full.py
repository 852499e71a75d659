"""Whether a key says which parameter it is about: if not, an error of its value does.

`**.power = 2W` is meant for transmitters, and read for the background noise, too.
"""

import re

_INDEX = re.compile(r"\[[^\]]*\]")
_WILDCARD = re.compile(r"[*?]|\{[^}]*\}")


def says_in_full(key: str, parameter: str) -> bool:
    """Whether what follows the wildcards of a key ends in all names of a parameter, whatever the indices.

    `parameter` is what stands below the name of a node or of a part of the network: "mobility.speed".
    """
    return _WILDCARD.split(_INDEX.sub("", key))[-1].endswith(f".{_INDEX.sub('', parameter)}")
