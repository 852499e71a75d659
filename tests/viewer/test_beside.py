"""The page that shows two replays side by side, in a browser."""

import shutil

import pytest

from gradysim.replay import read_replay
from gradysim.replay.beside import ReplaysBeside
from viewer.conftest import state, viewing

TABLE = """[...document.querySelectorAll(".differences tr")].map(
  (row) => [...row.children].map((cell) => cell.textContent))"""
# Where the names of the nodes are, in each of the views: sides of their box in pixels of the page.
BOXES = """[...document.querySelectorAll("canvas.labels")].map((canvas) => {
  const [width, height] = [canvas.width, canvas.height - 45];  // without the scale
  const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
  const covered = [...Array(width * height).keys()].filter((pixel) => data[4 * pixel + 3] > 100);
  const [x, y] = [covered.map((pixel) => pixel % width), covered.map((pixel) => Math.floor(pixel / width))];
  return [x, y].flatMap((all) => [Math.min(...all), Math.max(...all)]);
})"""
FOLD = "g"  # the legend, which is on the canvas of the names
VISIBLE = """[...document.querySelectorAll(".stage, .differences tr, button.main")].every((element) => {
  const { left, top, right, bottom } = element.getBoundingClientRect();
  return left >= 0 && top >= 0 && right <= innerWidth && bottom <= innerHeight;
})"""


def number(text):
    return int(text.replace(",", "").replace("\N{MINUS SIGN}", "-"))


@pytest.fixture
def beside(collisions, reports, browser):
    """A function that shows both runs and returns what the page says."""

    def show(hash="", files=(collisions, reports), **asked):
        with viewing(*files) as (view, address):
            said = browser(None, url=address + hash, **asked)
            assert view.wait(20) == 0
        return said

    return show


def test_the_table_has_the_outcomes_of_both_runs_and_their_differences(beside, collisions, reports):
    said = beside("#t=10.5", values={"table": TABLE})
    head, *rows = said["values"]["table"]
    assert head == ["", "General #0", "Jittered #0", "difference"]
    first, second = (state(read_replay(file), 10.5) for file in (collisions, reports))
    expected = {
        name.replace("_", " "): [one["outcomes"].get(name, 0) for one in (first, second)]
        for name in first["outcomes"] | second["outcomes"]
    }
    expected["receptions"] = [sum(one["outcomes"].values()) for one in (first, second)]
    expected["frames"] = [first["frames"], second["frames"]]
    assert {name: [number(cell) for cell in cells] for name, *cells in rows} == {
        name: [left, right, right - left] for name, (left, right) in expected.items()
    }
    assert said["console"] == []


def test_one_set_of_controls_moves_both_views(beside):
    values = {"boxes": BOXES, "plays": "document.querySelectorAll('button.main').length"}
    (start, same), (turned, also) = (
        beside("#t=2", keys=[FOLD, *keys], values=values)["values"]["boxes"] for keys in ([], ["t"])
    )
    assert start == same
    assert turned == also != start
    later = beside("#t=2", keys=[FOLD, "PageDown", {"until": "#t=12"}], values=values)["values"]
    assert later["boxes"][0] == later["boxes"][1] != start
    assert later["plays"] == 1


def test_a_step_goes_to_the_next_frame_of_any_run(beside, collisions, reports):
    starts_ns = {
        start
        for file in (collisions, reports)
        for start in read_replay(file).table("frames")["time_ns"]
        if start > 5e9
    }
    times = [f"#t={start / 1e9:.9f}".rstrip("0").rstrip(".") for start in sorted(starts_ns)[:3]]
    beside("#t=5", keys=[step for time in times for step in ("ArrowRight", {"until": time})])


@pytest.mark.parametrize(("width", "height"), [(1400, 850), (800, 800)])
def test_views_outcomes_and_controls_are_in_view(beside, width, height):
    said = beside("#t=10.5", width=width, height=height, values={"visible": VISIBLE})
    assert said["values"]["visible"]
    assert not said["scrolls_sideways"]


@pytest.mark.verify
def test_on_a_phone_the_views_are_stacked(beside):
    tops = "[...document.querySelectorAll('.stage')].map((stage) => stage.getBoundingClientRect().top)"
    said = beside(width=390, values={"tops": tops})
    first, second = said["values"]["tops"]
    assert second > first + 200
    assert not said["scrolls_sideways"]


def test_messages_of_other_pages_are_ignored(beside):
    told = "{ timeNs: 9e9, speed: 1000, isPlaying: true }"
    send = f"""for (const origin of ["http://example.com", location.origin])
      window.dispatchEvent(new MessageEvent("message", {{ data: {told}, origin, source: window }}))"""
    shown = "[document.querySelector('input.time').value, document.querySelector('button.main').textContent]"
    said = beside("#t=2", keys=[{"run": send}], values={"shown": shown})
    assert said["values"]["shown"] == ["2.000000", "Play"]


def test_scripts_of_replays_are_not_executed(beside, collisions, reports, tmp_path):
    hostile = tmp_path / "hostile.html"
    harm = "<script>parent.harm = 1; window.harm = 2</script><img src=x: onerror='window.harm = 3'>"
    hostile.write_text(collisions.read_text() + harm)
    said = beside(files=(hostile, reports), values={"harm": "String(window.harm)", "table": TABLE})
    assert said["values"]["harm"] == "undefined"
    assert said["values"]["table"][0][1] == "General #0"
    assert all("Content Security Policy" in line for line in said["console"])


def test_a_mistake_in_the_filter_of_an_address_is_shown(beside):
    said = beside(
        "#t=2&filter=sender:vehicles", values={"time": "document.querySelector('input.time').value"}
    )
    assert said["values"]["time"] == "2.000000"
    assert "sender" in said["text"].partition("Node")[0]


def test_a_replay_that_is_gone_or_damaged_is_named(collisions, browser, tmp_path):
    gone, damaged = tmp_path / "gone.html", tmp_path / "damaged.html"
    for file in (gone, damaged):
        shutil.copy(collisions, file)
    with ReplaysBeside([collisions, gone]) as server:
        gone.unlink()
        browser(None, url=server.address, is_broken=True, until="gone.html: ")
    with ReplaysBeside([collisions, damaged]) as server:
        damaged.write_text(damaged.read_text().replace('"format":2', '"format":1'))
        browser(None, url=server.address, is_broken=True, until="damaged.html: ")
