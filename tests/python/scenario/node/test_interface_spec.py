from dataclasses import fields

from gradysim.scenario.node.interface_spec import STRUCTS, InterfaceSpec


def test_all_mappings_are_structs() -> None:
    """One that is left out is not read from a file, and not reported where nothing reads it."""
    assert list(STRUCTS) == [field.name for field in fields(InterfaceSpec) if field.default_factory is dict]
