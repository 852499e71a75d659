"""The sequence chart of the replay page, in a browser."""

import re

import pytest

from gradysim.integrated.run import IntegratedRun
from gradysim.replay import read_replay
from gradysim.replay.sink import ReplayWriter
from gradysim.scenario import load_scenarios
from python.quiet_protocol import QUIET
from python.thorough import some

NAMES = "[...document.querySelectorAll('.lanes .name')].map((name) => name.firstChild.textContent)"
TITLES = "[...document.querySelectorAll('.lanes {} title')].map((title) => title.textContent)"
SENT = TITLES.format(".sent")
AXIS = "[...document.querySelectorAll('.lanes svg .axis')].map((text) => text.textContent)"
CHOSEN = """(() => {
  const { left, width } = document.querySelector(".lanes .chosen rect.sent").getBoundingClientRect();
  return { left, width };
})()"""
TWICE = """
from gradysim.protocol.messages.communication import BroadcastMessageCommand

class Twice(Quiet):
    def initialize(self):
        self.provider.schedule_timer("both", 1)

    def handle_timer(self, timer):
        for message in ("first", "second"):
            self.provider.send_communication_command(BroadcastMessageCommand(message))
"""


def starts(titles):
    """Return the start of each frame in nanoseconds, from its title."""
    return [round(float(re.search(r"\n([\d.]+) s for", title)[1]) * 1e9) for title in titles]


def test_it_shows_the_frames_around_the_clock(reports, browser):
    said = browser(
        reports, address="#t=2.1", keys=["s", {"until": "sequence=1"}], values={"sent": SENT, "names": NAMES}
    )
    began = [start for start in read_replay(reports).table("frames")["time_ns"] if 2.0e9 <= start <= 2.4e9]
    assert len(began) > 4
    assert starts(said["values"]["sent"]) == began
    assert said["values"]["names"] == [*(f"vehicles[{number}]" for number in range(5)), "station"]


def test_a_click_chooses_a_frame(reports, browser):
    began = read_replay(reports).table("frames")["time_ns"]
    frame = next(number for number, start in enumerate(began) if start >= 2.0e9) + 1
    second = {"click": ".lanes .sent >> nth=1"}
    browser(reports, address="#t=2.1&sequence=1", keys=[second], until=f"&frame={frame}")


def test_a_click_beside_frames_moves_the_clock(reports, browser):
    line = {"drag": ".lanes .lane >> nth=5", "by": 0}  # in the middle of 2.05 to 2.45 s
    browser(reports, address="#t=2.15&sequence=1", keys=[line], until="#t=2.2")


def test_a_collision_is_shown_with_its_interferer(zigzag, browser):
    replay = read_replay(zigzag)
    lost = next(row for row in replay.receptions() if row.outcome == "interference")
    name = [node["name"] for node in replay.run["nodes"]]
    rows = replay.table("interferers")
    interferer = name[rows["node"][list(rows["frame"]).index(lost.frame)]]
    sender = name[replay.table("frames")["node"][lost.frame]]
    said = browser(
        zigzag,
        address="#t=0&sequence=1&filter=outcome:interference",
        keys=["Shift+ArrowRight", {"until": f"&frame={lost.frame}"}],
        values={"names": NAMES, "interferer": TITLES.format(".interferer"), "sent": SENT},
    )
    assert said["values"]["interferer"] == [f"{interferer} interfered at {name[lost.receiver]}"]
    assert {sender, interferer, name[lost.receiver]} <= set(said["values"]["names"])
    assert {title.split(" → ")[0] for title in said["values"]["sent"]} == {sender, interferer}


def test_losses_have_the_words_of_their_outcome(town, browser):
    outcomes = TITLES.format(".chosen .reception")
    keys = ["ArrowRight", {"until": "&frame="}]
    values = {"outcomes": outcomes, "crosses": "document.querySelectorAll('.lanes .chosen .cross').length"}
    said = browser(town, address="#t=0.7&sequence=1", keys=keys, values=values)
    lines = [title.split("\n")[-1] for title in said["values"]["outcomes"]]
    assert lines[:2] == ["drones[0]: below sensitivity", "drones[1]: below sensitivity"]
    assert set(lines[2:]) == {f"drones[{number}]: delivered" for number in range(2, 8)}
    assert said["values"]["crosses"] == 2


def test_a_frame_says_how_long_ago_its_timer_fired(browser, tmp_path):
    (tmp_path / "twice.py").write_text(QUIET + TWICE, encoding="utf-8")
    ini = '[General]\nsim-time-limit = 2s\n*.uavs.count = 2\n*.uavs[0].protocol.class = "twice.py:Twice"\n'
    ini += '*.uavs[1].protocol.class = "twice.py:Quiet"\n'
    (tmp_path / "twice.ini").write_text(ini, encoding="utf-8")
    replay = tmp_path / "run.html"
    IntegratedRun(load_scenarios(tmp_path / "twice.ini")[0], replay=ReplayWriter(replay)).execute()
    _, second = read_replay(replay).table("frames")["time_ns"]
    said = browser(
        replay,
        address="#t=1.001&sequence=1",
        keys=["ArrowLeft", {"until": "&frame=1"}],
        values={"waits": TITLES.format(".wait")},
    )
    assert said["values"]["waits"] == [
        f"timer both last fired {(second - 1e9) / 1e3:.1f}".removesuffix(".0") + " µs before"
    ]


def test_the_wheel_zooms_and_dragging_pans(zigzag, browser):
    keys = ["Home", "ArrowRight", {"until": "&frame=0"}]
    lanes = ".lanes > svg"
    first = browser(zigzag, address="#sequence=1", keys=keys, values={"chosen": CHOSEN})["values"]["chosen"]
    wheel = [*keys, {"wheel": lanes, "by": -100}]
    zoomed = browser(zigzag, address="#sequence=1", keys=wheel, values={"chosen": CHOSEN})["values"]["chosen"]
    assert zoomed["width"] == pytest.approx(first["width"] * 2.718281828**0.25, rel=0.02)
    drag = [*keys, {"drag": lanes, "by": 60}]
    moved = browser(zigzag, address="#sequence=1", keys=drag, values={"chosen": CHOSEN})
    assert moved["values"]["chosen"]["left"] == pytest.approx(first["left"] + 60, abs=1)
    assert moved["address"].endswith("&frame=0")  # a drag is not a click


def test_a_link_to_a_frame_shows_it_at_once(zigzag, browser):
    said = browser(zigzag, address="#frame=1&sequence=1", values={"chosen": CHOSEN})
    assert said["values"]["chosen"]["width"] == pytest.approx(100, abs=3)


def test_pinned_nodes_have_lanes(zigzag, browser):
    said = browser(zigzag, address="#t=30&sequence=1&pins=sensors[4],uavs[0]", values={"names": NAMES})
    assert said["values"]["names"] == ["uavs[0]", "sensors[4]"]


@pytest.mark.parametrize(("width", "dark"), some([(390, True), (800, False), (1400, True)]))
def test_it_fits(zigzag, browser, width, dark):
    said = browser(
        zigzag,
        address="#t=30&sequence=1&node=uavs[0]",
        width=width,
        dark=dark,
        values={"axis": AXIS, "names": NAMES},
    )
    assert not said["scrolls_sideways"]
    assert len(said["values"]["axis"]) >= 3
    assert "uavs[0]" in said["values"]["names"]
    assert said["console"] == []
