"""Generate files from the declarations of the engine's fields: the keys of .ini files, and a type stub.

    make schema

Run it after changing a declaration in cpp/netsim/config, the only directory that it compiles. A test fails
while the files are stale.
"""

import json
import subprocess
import textwrap
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

CPP = Path(__file__).parents[1]
PROGRAM = CPP.parent / "build" / "schema" / "netsim_schema"
PACKAGE = CPP.parent / "python" / "gradysim"
SCHEMA = PACKAGE / "scenario" / "schema" / "schema.json"
STUB = PACKAGE / "_netsim_fields.pyi"

FIXED_TYPES = ("medium", "interface")
"""Structs whose type sets the defaults of other fields, and is read-only."""


def declarations() -> list[dict[str, Any]]:
    """Return the declarations of all fields, from a program that is compiled for it."""
    for step in ["--preset=schema"], ["--build", "--preset=schema"]:
        subprocess.run(["cmake", *step], cwd=CPP, check=True, stdout=subprocess.DEVNULL)
    return json.loads(subprocess.run([PROGRAM], check=True, stdout=subprocess.PIPE).stdout)


def schema_text(rows: Sequence[Mapping[str, Any]]) -> str:
    """Return the declarations as JSON, one per line."""
    lines = ",\n".join(json.dumps(row, ensure_ascii=False) for row in rows)
    return f"[\n{lines}\n]\n"


def stub_text(rows: Sequence[Mapping[str, Any]]) -> str:
    """Return one class per struct with its fields, which the struct's class in _netsim.pyi inherits."""
    lines = [
        '"""The declared fields of the config structs. Written by `make schema`; do not edit."""',
        "",
        "from collections.abc import Sequence",
        "from typing import TypeAlias",
        "",
        "MessagePart: TypeAlias = str | tuple[float, str] | tuple[str]",
    ]
    struct = ""
    for row in rows:
        of_struct, _, field = row["target"].partition(".")
        if of_struct != struct:
            struct = of_struct
            lines += ["", f"class {struct.capitalize()}Fields:"]
        if field == "typename" and struct in FIXED_TYPES:
            lines += ["    @property", "    def typename(self) -> str: ..."]
        else:
            lines.append(f"    {field}: {_python_type(row['type']['kind'])}")
        if row["meaning"]:
            lines += _docstring(row["meaning"])
    return "\n".join(lines) + "\n"


def _python_type(kind: str) -> str:
    names = {"integer": "int", "bytes": "int", "boolean": "bool", "name": "str", "file": "str"}
    names |= {"bitrates": "Sequence[float]", "powers_by_bitrate": "Sequence[tuple[float, float]]"}
    return names.get(kind, "float")


def _docstring(meaning: str) -> list[str]:
    text = meaning[0].upper() + meaning[1:]
    lines = textwrap.wrap(f'"""{text}."""', 100)
    return textwrap.indent("\n".join(lines), "    ").splitlines()


if __name__ == "__main__":
    rows = declarations()
    SCHEMA.write_text(schema_text(rows), encoding="utf-8")
    STUB.write_text(stub_text(rows), encoding="utf-8")
