from gradysim.config.expression import parse_value
from gradysim.config.key_list import OWN_STRUCTS, UNKNOWN, key_sections
from gradysim.config.keys import NETWORK_KEYS, NODE_KEYS
from gradysim.integrated.engine_defaults import engine_defaults


def test_every_default_is_known() -> None:
    rows = [row for section in key_sections(engine_defaults()) for row in section.rows]
    assert [row.key for row in rows if row.default == UNKNOWN] == []


def test_every_default_that_is_listed_may_be_written() -> None:
    structs = {**engine_defaults(), **OWN_STRUCTS}
    for key in (*NODE_KEYS, *NETWORK_KEYS):
        if not key.default:
            default = getattr(structs[key.struct][""], key.field)
            assert key.kind.convert(parse_value(key.kind.show(default))) is not None, key.path
