"""Pictures and films that the page saves, the legend and the marks on them, in a browser."""

import base64
import io

import pytest
from PIL import Image

from viewer.test_page import FLIES, run_of

BACKGROUND = (0xF6, 0xF7, 0xF8)
GROUP = (0x0B, 0x5C, 0xAD)
INTERFERENCE = (0xC1, 0x12, 0x1F)
RECEIVER_TRANSMITTING = (0xD9, 0x48, 0x0F)
RECEIVER_LOCKED = (0x7A, 0x3F, 0xB0)
LOSSES = (INTERFERENCE, RECEIVER_TRANSMITTING, RECEIVER_LOCKED)
STAGE = "(({ clientWidth, clientHeight }) => [clientWidth, clientHeight])(document.querySelector('.stage'))"
LEGEND, NAMES, TRAILS, TOP = "g", "l", "r", "t"


def near(picture, color, within=12):
    """Return the places of the pixels that have a color, or almost."""
    pixels, (wide, _) = picture.convert("RGB").get_flattened_data(), picture.size
    is_near = [sum(abs(a - b) for a, b in zip(pixel, color, strict=True)) <= within for pixel in pixels]
    return [(place % wide, place // wide) for place, has in enumerate(is_near) if has]


@pytest.fixture
def picture(browser, tmp_path):
    """A function that opens a replay and returns the picture that it saves, and the size of the scene."""

    def save(replay, keys=(), **asked):
        file = tmp_path / "saved.png"
        said = browser(replay, keys=[*keys, {"save": "c", "as": str(file)}], values={"size": STAGE}, **asked)
        with Image.open(file) as image:
            return image.copy(), tuple(said["values"]["size"])

    return save


def test_a_picture_has_the_colors_of_the_page_and_two_pixels_for_each(collisions, picture):
    saved, (width, height) = picture(collisions, [LEGEND, "Shift+ArrowRight", {"until": "&frame="}])
    assert saved.size == (2 * width, 2 * height)
    assert all(len(near(saved, color)) > 20 for color in LOSSES)
    assert len(near(saved, BACKGROUND)) > width * height


def test_the_legend_has_groups_and_outcomes_and_can_be_folded(collisions, picture):
    shown, _ = picture(collisions, [NAMES])
    folded, _ = picture(collisions, [NAMES, LEGEND])
    assert all(near(shown, color) for color in LOSSES)
    assert not any(near(folded, color) for color in LOSSES)


def test_a_node_that_moves_shows_where_it_goes(browser, picture, tmp_path):
    plain = [LEGEND, NAMES, TRAILS, TOP]
    (width, height), offset = shape(picture(run_of(tmp_path, FLIES, 120), plain, address="#t=50")[0])
    assert abs(width - height) <= 2
    (width, height), offset = shape(picture(tmp_path / "one.html", plain, address="#t=110")[0])
    assert width > 1.3 * height
    assert offset < -1  # the point is to the right: it flies along x


def shape(picture):
    """Return the size of the mark of a node, and how far right its center of mass is of its middle."""
    x, y = zip(*near(picture, GROUP), strict=True)
    size = max(x) - min(x) + 1, max(y) - min(y) + 1
    return size, sum(x) / len(x) - (max(x) + min(x)) / 2


def test_a_film_can_be_played(collisions, browser, tmp_path):
    keys = ["v", "Shift+ArrowRight", {"until": "&frame="}, {"save": "v", "as": str(tmp_path / "film.webm")}]
    said = browser(collisions, keys=keys, values={"size": STAGE})
    with Image.open(io.BytesIO(base64.b64decode(said["film"]["end"].partition(",")[2]))) as end:
        assert end.size == tuple(2 * length for length in said["values"]["size"])
        assert all(near(end, color, within=60) for color in LOSSES)
    assert said["console"] == []


def test_a_key_that_is_pressed_twice_records_one_film(collisions, browser, tmp_path):
    watch = """window.films = []; window.VideoEncoder = class extends VideoEncoder {
      constructor(init) { super(init); films.push(this); }
    }"""
    twice = """for (let time = 0; time < 2; time += 1)
      document.body.dispatchEvent(new KeyboardEvent("keydown", { key: "v", bubbles: true }))"""
    moved = ["Shift+ArrowRight", {"until": "&frame="}]
    keys = [{"run": watch}, {"run": twice}, *moved, {"save": "v", "as": str(tmp_path / "film")}]
    values = {"films": "films.map(({ state }) => state)"}
    assert browser(collisions, keys=keys, values=values)["values"]["films"] == ["closed"]


@pytest.mark.verify
def test_a_browser_that_cannot_record_says_so(collisions, browser):
    browser(collisions, keys=[{"run": "delete window.VideoEncoder"}, "v"], until="cannot record a film")
