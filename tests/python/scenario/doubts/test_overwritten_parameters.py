from typing import Any

import pytest

from gradysim.scenario.doubts.overwritten_parameters import overwritten_parameters

PROTOCOLS = """
from protocols import Sensor


class Base(Sensor):
    period = 1.0
    other = 2.0

    {code}


class Derived(Base):
    pass


class Anew(Base):
    def initialize(self):
        pass


class Calls(Base):
    def initialize(self):
        super().initialize()
        self.period = 4.0
"""


def told(folder: Any, code: str, name: str = "Base", lines: str = "*.uavs[*].protocol.period = 3s\n") -> Any:
    folder.write("sets.py", PROTOCOLS.format(code=code))
    chosen = f'[X]\n*.uavs[*].protocol.class = "sets.py:{name}"\n'
    return list(overwritten_parameters(folder.load(f"{chosen}{lines}", "X").nodes))


def test_a_line_whose_value_nothing_sees_is_told_once(folder: Any) -> None:
    (text,) = told(folder, "def initialize(self): self.period = 5.0")
    assert text == (
        f"{folder.ini}:8: warning: it has no effect: `initialize` of Base sets `self.period` before anything"
        " reads it; expected the default in the body of the class alone, `period = ...`"
    )


@pytest.mark.parametrize(
    "code",
    [
        "def initialize(self): self.period: float = 5.0",
        "def initialize(self): self.a = self.period = 5.0",
        "def initialize(self): self.provider.schedule_timer('x', self.other); self.period = self.other",
        "def initialize(self): self.period = 5.0; self.other = self.period",
        "def __init__(self): self.period = 5.0",
        "def __init__(self, period=5.0): self.period = period",
        "def __init__(self):\n        self.period = 5.0\n    def initialize(self): print(self.period)",
        "def __init__(self):\n        self.a = 5.0\n    def initialize(self): self.period = 5.0",
    ],
)
def test_ways_to_overwrite_it(folder: Any, code: str) -> None:
    assert len(told(folder, code)) == len(told(folder, code, name="Derived")) == 1


@pytest.mark.parametrize(
    "code",
    [
        "def initialize(self): self.a = self.period",
        "def initialize(self): self.period = 2 * self.period",
        "def initialize(self): self.period += 1",
        "def initialize(self): self.period += 1; self.period = 3.0",
        "def initialize(self): self.a = 1 / self.period; self.period = 5.0",
        "def initialize(self): self.a = Base.period; self.period = 5.0",
        "def initialize(self): self.provider.schedule_timer('x', 9); self.period: float",
        "def initialize(self): self.period = self.asked()",
        "def initialize(self): self.asked(); self.period = 5.0",
        "def initialize(self): print(self); self.period = 5.0",
        "def initialize(self): self.a = getattr(self, 'period'); self.period = 5.0",
        "def initialize(self): self.a = self.provider['period']; self.period = 5.0",
        "def initialize(self):\n        if self.other > 3: self.period = 5.0",
        "def initialize(self): message.period = 5.0",
        "def handle_timer(self, timer): self.period = 5.0",
        "def __init__(self):\n        self.a = self.period\n    def initialize(self): self.period = 5.0",
        "def __init__(self):\n        self.ask()\n    def initialize(self): self.period = 5.0",
    ],
)
def test_what_may_have_seen_the_value_is_not_told(folder: Any, code: str) -> None:
    assert told(folder, code) == []


def test_of_a_method_that_another_one_replaces_nothing_is_told(folder: Any) -> None:
    code = "def initialize(self): self.period = 5.0"
    assert told(folder, code, name="Anew") == told(folder, code, name="Calls") == []


def test_a_parameter_that_no_line_sets_is_not_told(folder: Any) -> None:
    lines = "*.uavs[*].protocol.other = 3s\n"
    assert told(folder, "def initialize(self): self.period = 5.0", lines=lines) == []
