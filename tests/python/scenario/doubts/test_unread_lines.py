from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.scenario.doubts.unread_lines import Chosen, UnreadLines, unmet_choice
from gradysim.scenario.errors import Source

DEFAULTS: dict[str, str | None] = {
    "medium.typename": "Ieee80211ScalarRadioMedium",
    "medium.path_loss": "FreeSpacePathLoss",
    "interface.typename": "Ieee80211Interface",
    "mac.rate_control": "",
}


def chosen(**others: str | None) -> Chosen:
    """What is in force: `chosen(path_loss="RicianFading")`."""
    in_force = {short(target): name for target, name in DEFAULTS.items()} | others
    return lambda target: in_force[short(target)]


def short(target: str) -> str:
    return "interface" if target == "interface.typename" else target.partition(".")[2]


def line(number: int, key: str = "**.key", file: str = "a.ini") -> Source:
    return Source(Path(file), number, key, "1")


@pytest.fixture
def texts() -> Callable[..., list[str]]:
    """The texts for some lines that are in force for one node or the network."""

    def of(sources: dict[str, Source], in_force: Chosen) -> list[str]:
        lines = UnreadLines()
        lines.add(sources, in_force, "uavs[*]")
        return list(lines.texts())

    return of


@pytest.mark.parametrize(
    ("target", "in_force", "lacking"),
    [
        ("medium.sigma_db", chosen(), "medium.path_loss"),
        ("medium.sigma_db", chosen(path_loss="LogNormalShadowing"), None),
        ("medium.sigma_db", chosen(typename="UnitDiskRadioMedium"), "medium.typename"),
        ("mac.rate_interval_s", chosen(), "mac.rate_control"),
        ("mac.rate_interval_s", chosen(rate_control=None), None),
        ("mac.rate_interval_s", chosen(interface="Ieee802154NarrowbandInterface"), "interface.typename"),
        ("mobility.initial_heading_rad", chosen(), None),
        ("protocol.speed", chosen(), None),
    ],
)
def test_the_outermost_choice_that_is_lacking(target: str, in_force: Chosen, lacking: str | None) -> None:
    choice = unmet_choice(target, in_force)
    assert (choice and choice.chosen_by) == lacking


def test_the_text_says_where_what_and_how(texts: Callable[..., list[str]]) -> None:
    assert texts({"medium.sigma_db": line(7, "*.radioMedium.pathLoss.sigma")}, chosen()) == [
        "a.ini:7: warning: nothing reads `*.radioMedium.pathLoss.sigma`: that takes"
        ' `*.radioMedium.pathLoss.typename = "LogNormalShadowing"`, and it is "FreeSpacePathLoss"'
    ]


def test_the_choice_of_a_node_is_told_with_its_group(texts: Callable[..., list[str]]) -> None:
    (text,) = texts({"mac.rate_interval_s": line(3)}, chosen())
    assert text.endswith(
        ' takes `*.uavs[*].wlan[*].mac.dcf.rateControl.typename = "ArfRateControl" or "AarfRateControl"`,'
        ' and it is ""'
    )


@pytest.mark.parametrize(
    ("key", "interface"),
    [
        ("*.uavs[*].wlan[1].mac.dcf.rateControl.interval", "wlan[1]"),
        ("**.wlan[1..3].mac.dcf.rateControl.interval", "wlan[1..3]"),
        ("**.wlan[..3].mac.dcf.rateControl.interval", "wlan[..3]"),
        ("**.wlan[*].mac.dcf.rateControl.interval", "wlan[*]"),
        ("**.rateControl.interval", "wlan[*]"),
    ],
)
def test_the_choice_is_told_for_the_interface_of_the_line(
    texts: Callable[..., list[str]], key: str, interface: str
) -> None:
    (text,) = texts({"mac.rate_interval_s": line(3, key)}, chosen())
    assert f"that takes `*.uavs[*].{interface}.mac.dcf.rateControl.typename = " in text


def test_lines_of_two_interfaces_are_told_apart(texts: Callable[..., list[str]]) -> None:
    lines = {
        "mac.rate_interval_s": line(3, "**.wlan[0].mac.dcf.rateControl.interval"),
        "mac.increase_threshold": line(4, "**.wlan[1].mac.dcf.rateControl.increaseThreshold"),
    }
    assert [text.partition(":")[2][0] for text in texts(lines, chosen())] == ["3", "4"]


def test_a_line_that_is_read_is_not_told(texts: Callable[..., list[str]]) -> None:
    assert texts({"medium.sigma_db": line(3)}, chosen(path_loss="LogNormalShadowing")) == []


@pytest.mark.parametrize("order", [1, -1])
def test_a_line_that_one_of_the_nodes_reads_is_not_told(order: int) -> None:
    lines = UnreadLines()
    for in_force in [chosen(), chosen(rate_control="ArfRateControl")][::order]:
        lines.add({"mac.rate_interval_s": line(3)}, in_force, "uavs[*]")
    assert list(lines.texts()) == []


def test_a_line_with_wildcards_is_read_by_one_of_its_keys(texts: Callable[..., list[str]]) -> None:
    assert texts({"medium.sigma_db": line(3), "medium.alpha": line(3)}, chosen()) == []


def test_all_that_is_chosen_instead_is_told() -> None:
    lines = UnreadLines()
    for rate_control in ("MinstrelRateControl", ""):
        lines.add({"mac.rate_interval_s": line(3)}, chosen(rate_control=rate_control), "uavs[*]")
    (text,) = lines.texts()
    assert text.endswith('and it is "" or "MinstrelRateControl"')


def test_lines_that_lack_the_same_are_told_together(texts: Callable[..., list[str]]) -> None:
    targets = ("rate_interval_s", "increase_threshold", "decrease_threshold")
    (text,) = texts(
        {f"mac.{target}": line(number) for number, target in enumerate(targets, start=4)}, chosen()
    )
    assert text.startswith("a.ini:4: warning: nothing reads `**.key`, nor lines 5 and 6: that takes")


@pytest.mark.parametrize(
    ("other", "nor"),
    [
        (line(9), "nor line 9:"),
        (line(1, file="b.ini"), "nor line b.ini:1:"),
        (Source(Path("b.ini"), 0, "**.l01", "1", "--set"), "nor line --set **.l01=1:"),
    ],
)
def test_other_places_are_named(texts: Callable[..., list[str]], other: Source, nor: str) -> None:
    (text,) = texts({"medium.l01_db": line(4), "medium.l02_db": other}, chosen())
    assert nor in text


def test_a_few_lines_are_all_named(texts: Callable[..., list[str]]) -> None:
    fields = ("use_acks", "max_frame_retries", "ack_wait_s", "sifs_s", "max_backoffs")
    (text,) = texts({f"csma.{field}": line(number) for number, field in enumerate(fields, 1)}, chosen())
    assert ", nor lines 2, 3, 4 and 5:" in text


def test_many_lines_are_only_counted(texts: Callable[..., list[str]]) -> None:
    fields = ("use_acks", "max_frame_retries", "ack_wait_s", "sifs_s", "max_backoffs", "cca_s")
    (text,) = texts({f"csma.{field}": line(number) for number, field in enumerate(fields, 1)}, chosen())
    assert ", nor 5 other lines:" in text
