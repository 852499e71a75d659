"""Draws the pictures of docs/explanation/how-the-engine-works.md: `make pictures`."""

import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")

import numpy as np
from matplotlib import pyplot
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrowPatch, FancyBboxPatch
from PIL import Image

from gradysim.integrated.compiled_part import load_netsim
from gradysim.integrated.network import medium_config, node_config
from gradysim.integrated.run import IntegratedRun
from gradysim.replay import Replay, read_replay
from gradysim.replay.sink import ReplayWriter
from gradysim.replay.tables import FRAME_KINDS
from gradysim.scenario import Scenario, load_scenarios

HERE = Path(__file__).parent

BLUE, ORANGE, GREEN, RED = "#2a6fb0", "#e08a1e", "#3c8d4f", "#b3403a"
GRAY, LIGHT, INK = "#8a8f98", "#d8dce2", "#20242a"
LOOK = {
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "text.color": INK,
    "axes.labelcolor": INK,
}

SLOT_US, SIFS_US, DIFS_US = 9, 10, 28
"""Of 802.11g without stations of 802.11b: DIFS is SIFS and two slots."""


def recorded(config: str) -> tuple[Scenario, Replay]:
    """Run a configuration of scenarios.ini, and return it with its replay."""
    (scenario,) = load_scenarios(HERE / "scenarios.ini", config)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "replay.html"
        IntegratedRun(scenario, replay=ReplayWriter(file)).execute()
        return scenario, read_replay(file)


def save(figure: Figure, name: str) -> None:
    """Write a picture of the page, with few colors so that the file is small."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "picture.png"
        figure.savefig(file, dpi=130, facecolor="white", bbox_inches="tight", pad_inches=0.1)
        picture = Image.open(file).convert("RGB")
    picture.quantize(128, Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE).save(
        HERE.parent / f"{name}.png", optimize=True
    )
    pyplot.close(figure)


# ---- The way of a frame ---

LAYERS = ("protocol", "node", "MAC", "radio")
SENDER = (
    ("send_communication_command", "your class, in Python or C++"),
    ("Node::broadcast, Node::send", "chooses the interface"),
    ("Dcf::send, Contention, Dcf::transmit", "queue, channel access, bitrate"),
    ("Radio::transmit", "adds power and band"),
)
RECEIVER = (
    ("handle_packet", "your class"),
    ("Protocol::message_received", "records the delay"),
    ("Dcf::frame_received", "address, duplicates, ACK"),
    ("Radio::arrival_started, arrival_ended", "locks on; one draw decides"),
)


def box(axes: Axes, x: float, y: float, width: float, texts: tuple[str, str, str], color: str) -> None:
    """Draw a box with a heading, a name of the sources, and what happens there."""
    axes.add_patch(
        FancyBboxPatch(
            (x, y),
            width,
            0.8,
            boxstyle="round,pad=0,rounding_size=0.08",
            facecolor=color + "22",
            edgecolor=color,
            linewidth=1.2,
        )
    )
    heading, name, what = texts
    axes.text(x + 0.12, y + 0.58, heading, fontweight="bold", va="center", color=color)
    axes.text(x + width - 0.12, y + 0.58, what, va="center", ha="right", fontsize=8)
    axes.text(x + 0.12, y + 0.23, name, va="center", family="monospace", fontsize=7.8)


def arrow(axes: Axes, start: tuple[float, float], end: tuple[float, float], **options: Any) -> None:
    """Draw an arrow."""
    look = {"arrowstyle": "-|>", "mutation_scale": 12, "color": INK, "linewidth": 1.3}
    axes.add_patch(FancyArrowPatch(start, end, **(look | options)))


def draw_way() -> None:
    """Draw the layers that a frame passes, at its sender and at a receiver."""
    figure, axes = pyplot.subplots(figsize=(7.6, 5.0))
    width, right = 4.3, 5.1
    for x, title, column, color in (
        (0.0, "Sender", SENDER, BLUE),
        (right, "Each receiver that notices it", RECEIVER, GREEN),
    ):
        axes.text(x + width / 2, 6.15, title, ha="center", fontsize=10.5, fontweight="bold")
        for level, (layer, (name, what)) in enumerate(zip(LAYERS, column, strict=True)):
            box(axes, x, 5.0 - level * 1.2, width, (layer, name, what), color)
    for level in range(len(LAYERS)):
        top, bottom = 5.0 - level * 1.2, 5.0 - level * 1.2 - 0.4
        arrow(axes, (width / 2, top), (width / 2, bottom))
        arrow(axes, (right + width / 2, bottom), (right + width / 2, top))
    axes.text(width / 2 + 0.15, 1.2, "frame", va="center", fontsize=8)
    axes.text(right + width / 2 + 0.15, 1.2, "arrival: power, start, end", va="center", fontsize=8)
    box(
        axes,
        0,
        0.2,
        right + width,
        ("medium", "Medium::transmit", "which radios can notice it, alone or together with other frames"),
        RED,
    )
    middle = (right + width) / 2
    box(
        axes,
        middle - 3.4,
        -1.2,
        6.8,
        ("propagation", "Propagation::gain", "path loss, fading, antennas, obstacles"),
        ORANGE,
    )
    arrow(axes, (middle - 1, 0.2), (middle - 1, -0.4))
    arrow(axes, (middle + 1, -0.4), (middle + 1, 0.2))
    axes.text(middle - 1.15, -0.1, "two places", ha="right", va="center", fontsize=8)
    axes.text(middle + 1.15, -0.1, "gain", va="center", fontsize=8)
    axes.set(xlim=(-0.1, right + width + 0.3), ylim=(-1.3, 6.4))
    axes.axis("off")
    save(figure, "way_of_a_frame")


# ---- Channel access ---


def draw_access() -> None:
    """Draw who is on the air when, and what the waiting stations count, from a run."""
    scenario, replay = recorded("Access")
    frames = rows(replay, "frames")
    begin_ns = frames[0]["time_ns"]
    names = [spec.name for spec in scenario.nodes]
    lane = {1: 3, 2: 2, 3: 1, 0: 0}
    figure, axes = pyplot.subplots(figsize=(7.6, 3.3))
    for frame in frames:
        kind = FRAME_KINDS[frame["kind"]]
        start, length = (frame["time_ns"] - begin_ns) / 1e3, frame["duration_ns"] / 1e3
        color, text = (GREEN, "ACK") if kind == "ack" else (BLUE, "frame")
        axes.broken_barh([(start, length)], (lane[frame["node"]] - 0.3, 0.6), facecolor=color)
        axes.text(
            start + length / 2, lane[frame["node"]], text, color="white", ha="center", va="center", fontsize=8
        )
    ends = [(frame["time_ns"] + frame["duration_ns"] - begin_ns) / 1e3 for frame in frames]
    starts = [(frame["time_ns"] - begin_ns) / 1e3 for frame in frames]
    first, second = frames[2]["node"], frames[4]["node"]
    slots = [round((starts[data] - ends[data - 1] - DIFS_US) / SLOT_US) for data in (2, 4)]
    for data, count in zip((2, 4), slots, strict=True):  # whole slots, but for the way at the speed of light
        assert 0 <= starts[data] - ends[data - 1] - DIFS_US - count * SLOT_US < 0.2
    axes.annotate(
        "SIFS",
        ((ends[0] + starts[1]) / 2, 0.32),
        ((ends[0] + starts[1]) / 2 - 25, 0.62),
        ha="center",
        fontsize=8,
        arrowprops={"arrowstyle": "-", "color": GRAY},
    )
    waits(axes, lane[first], ends[1], slots[0], f"{slots[0]} slots")
    waits(axes, lane[second], ends[1], slots[0], f"{slots[0]} of {sum(slots)} slots")
    waits(axes, lane[second], ends[3], slots[1], f"{slots[1]} slots")
    busy(axes, lane[second], starts[2], ends[3], f"busy, {slots[1]} slots left")
    for station in (first, second):
        spec = scenario.nodes[station]
        asked_us = spec.protocol_parameters["at"] * 1e6 - begin_ns / 1e3
        axes.plot(asked_us, lane[station], marker="v", color=RED, markersize=7)
        busy(axes, lane[station], asked_us, ends[1], "busy")
    axes.plot(0, lane[1] + 0.5, marker="v", color=RED, markersize=7)
    axes.plot([], [], "v", color=RED, markersize=7, label="the protocol sends a message")
    axes.set_yticks([lane[node] for node in lane], [names[node] for node in lane])
    axes.set(xlim=(-12, ends[-1] + 12), ylim=(-0.6, 3.75), xlabel="time in µs")
    axes.tick_params(left=False)
    axes.spines["left"].set_visible(False)
    axes.legend(loc="upper right", frameon=False, fontsize=8, borderpad=0, handletextpad=0.2)
    save(figure, "channel_access")


def busy(axes: Axes, level: float, start_us: float, end_us: float, text: str) -> None:
    """Draw that a station finds the channel busy."""
    axes.plot([start_us, end_us], [level, level], color=GRAY, linewidth=0.8, linestyle=":")
    axes.text((start_us + end_us) / 2, level + 0.08, text, ha="center", fontsize=8, color=GRAY)


def waits(axes: Axes, level: float, free_us: float, slots: int, note: str) -> None:
    """Draw DIFS and `slots` slots of backoff from where the channel became free."""
    axes.broken_barh([(free_us, DIFS_US)], (level - 0.3, 0.6), facecolor=LIGHT, edgecolor=GRAY, linewidth=0.6)
    axes.text(free_us + DIFS_US / 2, level, "DIFS", ha="center", va="center", fontsize=7)
    bars = [(free_us + DIFS_US + slot * SLOT_US, SLOT_US) for slot in range(slots)]
    axes.broken_barh(bars, (level - 0.3, 0.6), facecolor="white", edgecolor=ORANGE, linewidth=0.8)
    axes.text(
        free_us + DIFS_US + slots * SLOT_US / 2, level + 0.36, note, ha="center", fontsize=7.5, color=ORANGE
    )


def rows(replay: Replay, table: str) -> list[Mapping[str, Any]]:
    """Return a table of a replay as a list of rows."""
    columns = replay.table(table)
    return [dict(zip(columns, values, strict=True)) for values in zip(*columns.values(), strict=True)]


# ---- The culled medium ---


class Field:
    """The run `Energy`: the nodes that notice the frames of a and b, and the powers there."""

    def __init__(self) -> None:
        self.scenario, self.replay = recorded("Energy")
        self.nodes = {spec.name: spec for spec in self.scenario.nodes}
        medium = medium_config(self.scenario)
        self._propagation = load_netsim().Propagation(medium, self.scenario.seed)
        self._radio = node_config(self.nodes["a"]).wlan[0].radio
        self.noise_w = medium.background_noise_w
        self.threshold_w = self._radio.energy_detection_w
        self.level_w = self.threshold_w - self.noise_w

    def power_w(self, sender: str, receiver: str) -> float:
        """Return what arrives of a sender's power at a receiver."""
        places = [self.nodes[name].initial_position for name in (sender, receiver)]
        return float(self._radio.tx_power_w * self._propagation.gain(*places, self._radio.carrier_hz))

    def reach_m(self, power_w: float) -> float:
        """Return the distance at which that power arrives."""
        return float(self._propagation.reach_m(power_w / self._radio.tx_power_w, self._radio.carrier_hz))

    def notified(self, frame: int) -> set[str]:
        """Return who notices a frame alone: a sends frame 0, b frame 1."""
        return {
            self.scenario.nodes[reception.receiver].name
            for reception in self.replay.receptions()
            if reception.frame == frame
        }

    def together(self) -> set[str]:
        """Return where neither frame reaches the level, but both together do."""
        alone = self.notified(0) | self.notified(1) | {"a", "b", "listener"}
        return {
            name
            for name in self.nodes.keys() - alone
            if self.power_w("a", name) + self.power_w("b", name) >= self.level_w
        }


def draw_culling() -> None:
    """Draw which radios notice a frame, and how two weak frames make a channel busy, from a run."""
    field = Field()
    figure, (map_axes, time_axes) = pyplot.subplots(
        1, 2, figsize=(7.8, 3.5), width_ratios=[1.7, 1], layout="constrained"
    )
    draw_map(map_axes, field)
    draw_reaches(map_axes, field)
    draw_energy(time_axes, field)
    save(figure, "culled_medium")


def draw_map(axes: Axes, field: Field) -> None:
    """Draw the nodes: those that notice the frame of a alone, those that notice both together, the others."""
    named = {"a", "b", "listener"}
    noticed, together = field.notified(0), field.together()
    others = field.nodes.keys() - noticed - together - named
    for names, color, size, label in (
        (noticed, BLUE, 13, "notified of a's frame"),
        (together, ORANGE, 17, "busy by a and b"),
        (others, "#b9bec6", 7, "not notified"),
    ):
        places = [field.nodes[name].initial_position for name in sorted(names)]
        axes.scatter(
            [x for x, _, _ in places],
            [y for _, y, _ in places],
            s=size,
            color=color,
            label=f"{label} ({len(names)})",
        )
    for name in sorted(named):
        x, y, _ = field.nodes[name].initial_position
        axes.plot(x, y, marker="*" if name == "listener" else "^", color=RED, markersize=9)
        axes.annotate(name, (x, y), (6, 6), textcoords="offset points", fontweight="bold", color=RED)
    axes.set(aspect="equal", xlabel="x in m", ylabel="y in m", xlim=(0, 4000), ylim=(0, 2600), title="Places")
    axes.legend(
        loc="upper center",
        bbox_to_anchor=(0.5, -0.2),
        ncols=3,
        frameon=False,
        fontsize=8,
        handletextpad=0,
        columnspacing=1,
    )


def draw_reaches(axes: Axes, field: Field) -> None:
    """Draw where the frames of a and b are noticed alone, and two watch zones of a."""
    dashed = {"color": ORANGE, "linewidth": 0.9, "linestyle": "--"}
    for sender, share, style, text, angle in (
        ("a", 1.0, {"color": BLUE, "linewidth": 1.3}, "", 0.0),
        ("b", 1.0, {"color": GRAY, "linewidth": 1.0}, "", 0.0),
        ("a", 0.8, dashed, "4/5", 0.2),
        ("a", 0.6, dashed, "3/5", 0.5),
    ):
        x, y, _ = field.nodes[sender].initial_position
        radius_m = field.reach_m(share * field.level_w)
        axes.add_patch(Circle((x, y), radius_m, fill=False, **style))
        axes.text(
            x - radius_m * np.cos(angle),
            y + radius_m * np.sin(angle),
            text,
            color=ORANGE,
            fontsize=8,
            ha="center",
            va="center",
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5} if text else None,
        )


def draw_energy(axes: Axes, field: Field) -> None:
    """Draw the energy at the listener over time, and when it sends."""
    first, second, own = rows(field.replay, "frames")
    zero_ns, listener = first["time_ns"], field.nodes["listener"]
    times_us = np.linspace(-100, 1300, 2801)
    total_w = np.full_like(times_us, field.noise_w)
    for frame, sender, shift_us in ((first, "a", -150), (second, "b", 150)):
        start_us, length_us = (frame["time_ns"] - zero_ns) / 1e3, frame["duration_ns"] / 1e3
        power_w = field.power_w(sender, "listener")
        total_w += np.where((times_us >= start_us) & (times_us < start_us + length_us), power_w, 0)
        axes.text(
            start_us + length_us / 2 + shift_us,
            power_w / field.threshold_w / 2,
            f"{sender}: {power_w / field.threshold_w:.2f}",
            ha="center",
            fontsize=8,
        )
    shares = total_w / field.threshold_w
    axes.fill_between(times_us, shares, step="post", color=LIGHT, linewidth=0, zorder=0)
    axes.plot(times_us, shares, drawstyle="steps-post", color=INK, linewidth=1.2)
    axes.axhline(1, color=RED, linewidth=1)
    axes.text(1290, 1.02, "ED threshold: busy", color=RED, fontsize=8, ha="right")
    asked_us = listener.protocol_parameters["at"] * 1e6 - zero_ns / 1e3
    sent_us = (own["time_ns"] - zero_ns) / 1e3
    axes.plot(asked_us, -0.07, marker="v", color=RED, markersize=7)
    arrow(axes, (asked_us, -0.07), (sent_us, -0.07), color=GRAY)
    axes.broken_barh([(sent_us, own["duration_ns"] / 1e3)], (-0.12, 0.1), facecolor=BLUE)
    axes.text(sent_us + 20, -0.07, "its frame", color="white", fontsize=8, va="center")
    axes.set(
        xlim=(-100, 1300),
        ylim=(-0.14, 1.3),
        xlabel="time in µs",
        ylabel="energy, share of the threshold",
        title="At the listener",
    )


if __name__ == "__main__":
    with matplotlib.rc_context(LOOK):
        draw_way()
        draw_access()
        draw_culling()
