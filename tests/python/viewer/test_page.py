import base64
import hashlib
import json
import re

import pytest

from gradysim.viewer.page import json_text, live_page, page, page_beside, snapshot_page


@pytest.mark.parametrize(
    ("text", "element", "value"),
    [
        (live_page("/chunks"), "live", {"socket": "/chunks"}),
        (snapshot_page(), "snapshots", {"socket": "/"}),
        (
            page_beside("/viewer", {"/0": "a.html"}),
            "beside",
            {"socket": "/viewer", "replays": {"/0": "a.html"}},
        ),
    ],
)
def test_the_script_learns_where_the_run_is(text, element, value):
    (found,) = re.findall(rf'<script type="application/json" id="gradysim-{element}">(.*?)</script>', text)
    assert json.loads(found) == value
    assert len(text) > len(page())


def test_no_value_ends_its_element():
    value = {"name": "</script><script>alert(1)</script>"}
    assert "<" not in json_text(value)
    assert json.loads(json_text(value)) == value


def test_the_page_runs_its_own_script_only():
    (policy,) = re.findall('<meta http-equiv="Content-Security-Policy" content="(.*?)">', page())
    allowed = dict(directive.strip().split(" ", 1) for directive in policy.split(";"))
    assert allowed["default-src"] == "'none'"
    for name, element in (("script-src", "script"), ("style-src", "style")):
        (content,) = re.findall(f"<{element}>(.*?)</{element}>", page(), re.DOTALL)
        digest = base64.b64encode(hashlib.sha256(content.encode()).digest()).decode()
        assert allowed[name] == f"'sha256-{digest}'"
