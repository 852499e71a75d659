from gradysim.config.key_list import UNKNOWN, key_sections
from gradysim.integrated.engine_defaults import engine_defaults


def test_every_default_is_known() -> None:
    rows = [row for section in key_sections(engine_defaults()) for row in section.rows]
    assert [row.key for row in rows if row.default == UNKNOWN] == []
