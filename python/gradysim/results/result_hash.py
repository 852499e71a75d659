"""The hash of all that a run computed, which tells whether two runs did the same."""

import hashlib
import json
import re
from collections.abc import Mapping
from typing import Any

from gradysim.scenario.resolve.runs import HASH_DIGITS

OF_RUN = ("sim_time_s", "fingerprint", "outcomes", "message_delays", "nodes")
OF_NODE = ("name", "position", "tracked_variables", "frames_by_bitrate")
"""Fields that every run has. Others depend on options of a command, on the file, or on the machine."""

_HASHED_AS = {"outcomes": "fates"}
"""The former names of fields, under which they are hashed, so that hashes in stored files remain valid."""

_ADDRESS = re.compile(r" at 0x[0-9a-fA-F]+")
"""Part of the `repr` of an object, `<swarm.Mate object at 0x7f0c>`, that differs between processes."""


def result_hash(result: Mapping[str, Any]) -> str:
    """Return the hash of the computed fields of a run, from its JSON object or these fields of it."""
    computed = {_HASHED_AS.get(name, name): result[name] for name in OF_RUN if name in result}
    computed["nodes"] = [
        {name: node[name] for name in OF_NODE if name in node} for node in result.get("nodes", ())
    ]
    content = _ADDRESS.sub("", json.dumps(computed, sort_keys=True))
    return hashlib.sha256(content.encode()).hexdigest()[:HASH_DIGITS]
