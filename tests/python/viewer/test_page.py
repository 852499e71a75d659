import json
import re

import pytest

from gradysim.viewer.page import json_text, live_page, page, page_beside, snapshot_page


@pytest.mark.parametrize(
    ("text", "element", "value"),
    [
        (live_page("/chunks"), "live", {"socket": "/chunks"}),
        (snapshot_page(), "snapshots", {"socket": "/"}),
        (page_beside([]), "beside", []),
    ],
)
def test_the_script_learns_where_the_run_is(text, element, value):
    (found,) = re.findall(rf'<script type="application/json" id="gradysim-{element}">(.*?)</script>', text)
    assert json.loads(found) == value
    assert len(text) > len(page())


def test_no_value_ends_its_element():
    value = ["</script><script>alert(1)</script>"]
    assert "<" not in json_text(value)
    assert json.loads(json_text(value)) == value
