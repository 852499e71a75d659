"""Text and picture of a calibration; tests of its values are in tests/python/integrated."""

import errno
import math
import re
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("gradysim._netsim")

from gradysim.cli.calibrate import check_picture, draw, text_of_calibration
from gradysim.integrated.calibration import Calibration
from gradysim.scenario.parse.expressions import parse_value
from gradysim.scenario.schema.parameter_types import quantity


def calibration(interfaces: int = 1, deciding_sensitivity_w: float | None = None) -> Calibration:
    return Calibration(
        sender="relay",
        sender_interfaces=interfaces,
        receiver="relay",
        range_m=50,
        ratio=0.5,
        message_bytes=50,
        tx_power_w=0.001,
        bitrate_bps=24e6,
        frame_bytes=114,
        snr_at_range=10,
        deciding_sensitivity_w=deciding_sensitivity_w,
        curve=(),
    )


@pytest.mark.parametrize(("interfaces", "wlan"), [(1, "wlan[*]"), (2, "wlan[0]")])
def test_its_line_sets_the_power_of_the_interface_that_it_is_about(interfaces: int, wlan: str) -> None:
    lines = text_of_calibration(calibration(interfaces)).splitlines()
    assert f"    *.relay.{wlan}.radio.transmitter.power = 1mW" in lines


@given(st.floats(min_value=1e-15, max_value=1e9))
def test_its_powers_are_the_next_ones_that_are_enough(tx_power_w: float) -> None:
    printed = text_of_calibration(replace(calibration(), tx_power_w=tx_power_w))
    power = quantity("W")
    (in_mw,) = re.findall(r"power = (\S+)$", printed, re.MULTILINE)
    assert tx_power_w <= float(power.convert(parse_value(in_mw))) <= tx_power_w * (1 + 1.1e-5)
    (in_dbm,) = re.findall(r"with a power of (\S+) dBm:$", printed, re.MULTILINE)
    in_w = float(power.convert(parse_value(f"{in_dbm}dBm")))
    assert tx_power_w * (1 - 1e-12) <= in_w <= tx_power_w * 10**0.00011


def test_an_interface_that_is_not_the_first_is_named() -> None:
    lines = text_of_calibration(
        replace(calibration(2), sender_interface=1, receiver="base.wlan[1]")
    ).splitlines()
    assert lines[0] == "relay.wlan[1] to base.wlan[1]: 0.5 of the broadcast frames are received at 50 m"
    assert "    *.relay.wlan[1].radio.transmitter.power = 1mW" in lines


def test_a_sensitivity_that_decides_is_told() -> None:
    assert "-90 dBm" in text_of_calibration(calibration(deciding_sensitivity_w=1e-12))
    assert "sensitivity" not in text_of_calibration(calibration())


def test_a_channel_without_noise_is_told() -> None:
    assert "\n10.00 dB " in text_of_calibration(calibration())
    assert "\nwithout noise)" in text_of_calibration(replace(calibration(), snr_at_range=math.inf))


def test_a_preamble_that_asks_for_more_is_told() -> None:
    told = text_of_calibration(replace(calibration(), deciding_preamble_w=10**-11.2))
    assert "preambleDetection.minimumPower of -82 dBm" in told
    assert "sensitivity" not in told
    assert "preamble" not in text_of_calibration(calibration())


@pytest.mark.parametrize(("obstacles", "told"), [(1, "The obstacle is "), (2, "The 2 obstacles are ")])
def test_obstacles_that_are_left_out_are_told(obstacles: int, told: str) -> None:
    assert told in text_of_calibration(replace(calibration(), obstacles_left_out=obstacles))
    assert "obstacle" not in text_of_calibration(calibration())


@pytest.mark.parametrize(
    ("distance_m", "written"),
    [(2.5, "   2.5 m"), (2561.725, "2561.7 m"), (99_999.6, "100000 m"), (1_234_567.8, "1234568 m")],
)
def test_distances_are_metres_without_an_exponent(distance_m: float, written: str) -> None:
    lines = text_of_calibration(replace(calibration(), curve=((distance_m, 0.5),))).splitlines()
    assert lines[-1].startswith(f"{written}    50.00 %  █")


@pytest.mark.parametrize(
    ("name", "problem"),
    [
        ("nowhere/curve.png", r".*nowhere does .*"),
        ("curve.xyz", r"`\.xyz`.*`?\.png, \.svg or \.pdf"),
        ("curve", r".* \.png, \.svg or \.pdf"),
        ("folder.png", r".*directory.* file"),
    ],
)
def test_a_picture_that_cannot_be_is_refused_before_it_is_drawn(
    tmp_path: Path, name: str, problem: str
) -> None:
    pytest.importorskip("matplotlib")
    (tmp_path / "folder.png").mkdir()
    with pytest.raises(ValueError, match=rf"^--picture .*: {problem}$"):
        check_picture(tmp_path / name)


@pytest.mark.parametrize("name", ["curve.png", "curve.SVG"])
def test_a_picture_that_can_be_is_not(tmp_path: Path, name: str) -> None:
    pytest.importorskip("matplotlib")
    check_picture(tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_a_picture_that_finds_no_room_names_its_file(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    full_disk = Path("/dev/full")
    if not full_disk.exists():
        pytest.skip("this system has no disk that is always full")
    picture = tmp_path / "curve.svg"
    picture.symlink_to(full_disk)
    with pytest.raises(OSError) as raised:  # noqa: PT011
        draw(replace(calibration(), curve=((1.0, 0.5),)), picture)
    assert raised.value.errno == errno.ENOSPC
    assert raised.value.filename == str(picture)


def test_a_picture_says_which_interface_sends(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    picture = tmp_path / "curve.svg"
    curve = ((1.0, 0.5), (2.0, 0.25))
    draw(replace(calibration(2), sender_interface=1, receiver="base", curve=curve), picture)
    assert "<!-- relay.wlan[1] to " in picture.read_text(encoding="utf-8")
