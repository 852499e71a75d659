from typing import Any

import pytest

from gradysim.scenario.doubts.shared_containers import shared_containers

PROTOCOLS = """
from collections import defaultdict, deque
from protocols import Sensor


class Base(Sensor):
    heard = {value}

    def handle_packet(self, message):
        {code}


class Derived(Base):
    pass
"""


def told(
    folder: Any, code: str, value: str = "[]", lines: str = '*.uavs[*].protocol.class = "shares.py:Base"\n'
) -> list[str]:
    folder.write("shares.py", PROTOCOLS.format(code=code, value=value))
    return list(shared_containers(folder.load(f"[X]\n{lines}", "X").nodes))


def test_a_list_of_the_class_that_nodes_change_is_told_once(folder: Any) -> None:
    (text,) = told(folder, "self.heard.append(message)")
    assert text == (
        f"{folder.ini}:7: warning: `heard` in the body of Base is one list for all nodes, and `self.heard`"
        " changes it for all; expected `self.heard = ...` in `initialize`, or, if they are meant to share it,"
        " `Base.heard` where it changes"
    )


@pytest.mark.parametrize(
    ("code", "value"),
    [
        ("self.heard[message] = 1", "{}"),
        ("self.heard[message] += 1", "defaultdict(int)"),
        ("del self.heard[message]", "{}"),
        ("self.heard += [message]", "[]"),
        ("self.heard.add(message)", "set()"),
        ("self.heard.popleft()", "deque()"),
        ("last = self.heard.setdefault(message, 0)", "{}"),
    ],
)
def test_ways_to_change_it(folder: Any, code: str, value: str) -> None:
    assert len(told(folder, code, value)) == 1


@pytest.mark.parametrize(
    ("code", "value"),
    [
        ("print(self.heard[0], self.heard.index(message), len(self.heard))", "[]"),
        ("self.heard += 1", "0"),
        ("self.heard += message", "''"),
        ("self.heard = []; self.heard.append(message)", "[]"),
        ("self.heard: list[str] = []; self.heard.append(message)", "[]"),
        ("Base.heard.append(message)", "[]"),
        ("message.heard.append(1)", "[]"),
        ("self.other.append(message)", "[]"),
    ],
)
def test_what_changes_nothing_that_is_shared_is_not_told(folder: Any, code: str, value: str) -> None:
    assert told(folder, code, value) == []


def test_classes_that_inherit_share_it(folder: Any) -> None:
    lines = (
        '*.groundStation.protocol.class = "shares.py:Base"\n'
        '*.numUavs = 1\n*.uavs[*].protocol.class = "shares.py:Derived"\n'
    )
    (text,) = told(folder, "self.heard.append(message)", lines=lines)
    assert "in the body of Base is one list" in text


def test_a_node_that_has_it_alone_is_not_told(folder: Any) -> None:
    lines = '*.groundStation.protocol.class = "shares.py:Base"\n'
    assert told(folder, "self.heard.append(message)", lines=lines) == []


def test_a_class_that_gives_each_node_its_own_shares_nothing(folder: Any) -> None:
    text = PROTOCOLS.format(code="self.heard.append(message)", value="[]")
    own = "class Own(Base):\n    def initialize(self):\n        self.heard = []\n"
    folder.write("owns.py", text + own)
    nodes = folder.load('[X]\n*.uavs[*].protocol.class = "owns.py:Own"\n', "X").nodes
    assert list(shared_containers(nodes)) == []
