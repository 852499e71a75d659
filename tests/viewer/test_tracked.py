"""The charts of tracked variables of several nodes, in a browser."""

import pytest

from gradysim.replay import read_replay

CHARTS = """[...document.querySelectorAll('.charts > div')].map((chart) => ({
  name: chart.querySelector('.row > span').textContent,
  values: Object.fromEntries(
    [...chart.querySelectorAll('.end span')].map((one) => [one.title, Number(one.textContent)])
  ),
  clock: chart.querySelector('.now')?.getBoundingClientRect().left,
}))"""
TITLE = "document.querySelector('h3 + .legend').previousSibling.textContent"
LEGEND = "[...document.querySelectorAll('.legend span')].map((one) => one.textContent)"
CHART = ".charts .u-over >> nth=0"


def at(replay, name, node, time_s):
    """Return the value of a variable, from the tables."""
    table = replay.table("variables")
    rows = zip(table["time_ns"], table["node"], table["name"], table["value"], strict=True)
    return [
        value for start, of, what, value in rows if of == node and what == name and start <= time_s * 1e9
    ][-1]


def test_a_chart_has_a_curve_for_each_pinned_node(zigzag, browser):
    replay = read_replay(zigzag)
    keys = [
        {"choose": "uavs[0]"},
        "k",
        {"choose": "uavs[1]"},
        "k",
        {"choose": "groundStation"},
        {"until": "deliveries"},
        {"until": "node=groundStation&pins=uavs[0],uavs[1]"},
    ]
    said = browser(zigzag, address="#t=130", keys=keys, values={"charts": CHARTS, "legend": LEGEND})
    data = next(chart for chart in said["values"]["charts"] if chart["name"] == "data")
    nodes = {"uavs[0]": 0, "uavs[1]": 1, "groundStation": 7}
    assert data["values"] == {name: at(replay, "data", node, 130) for name, node in nodes.items()}
    assert said["values"]["legend"] == ["uavs[0]✕", "uavs[1]✕", "groundStation"]


def test_pinned_nodes_stay_when_no_node_is_chosen(zigzag, browser):
    unpin = {"click": ".legend button >> nth=0"}
    keys = [{"until": "collected"}, unpin]
    said = browser(zigzag, address="#t=130&pins=uavs[0],uavs[1]", keys=keys, values={"charts": CHARTS})
    assert {tuple(chart["values"]) for chart in said["values"]["charts"]} == {("uavs[1]",)}


def test_zooming_one_chart_zooms_all(zigzag, browser):
    whole = {"until": "collected"}
    address = "#t=130&pins=uavs[0],uavs[1]"
    before = browser(zigzag, address=address, keys=[whole], values={"charts": CHARTS})
    zoom = {"drag": CHART, "by": 60}
    after = browser(zigzag, address=address, keys=[whole, zoom], values={"charts": CHARTS})
    places = [{chart["clock"] for chart in said["values"]["charts"]} for said in (before, after)]
    assert [len(place) for place in places] == [1, 1]
    assert places[0] != places[1]


def test_the_values_are_those_under_the_mouse(zigzag, browser):
    keys = [{"until": "collected"}, {"wheel": CHART, "by": 0}]  # it only moves the mouse to the middle
    said = browser(zigzag, address="#t=30&pins=uavs[0]", keys=keys, values={"title": TITLE, "charts": CHARTS})
    time_s = float(said["values"]["title"].split()[-2])
    assert time_s == pytest.approx(125, abs=2)
    data = next(chart for chart in said["values"]["charts"] if chart["name"] == "data")
    assert data["values"]["uavs[0]"] == at(read_replay(zigzag), "data", 0, time_s)


def test_a_click_on_a_chart_moves_the_clock(zigzag, browser):
    keys = [{"until": "collected"}, {"drag": CHART, "by": 0}]
    browser(zigzag, address="#t=30&pins=uavs[0]", keys=keys, until="#t=12")
