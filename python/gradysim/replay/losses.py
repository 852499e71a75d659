"""Why receivers lost frames: the power that arrived, what was needed, and what took the rest.

In decibels, the received power is the sent power plus all gains of `Loss.gains`: path loss, antennas,
obstacles, shadowing and fading. The engine computes them with the models of the run.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from gradysim.replay.chunk import Chunk
from gradysim.replay.paths import Paths
from gradysim.replay.tables import NO_POWER

_SHOWN_DB = 0.05
"""Smaller gains are 0.0 in a text."""

_ALL_DB = -300.0
"""Smaller gains are not shown in full."""


@dataclass(frozen=True)
class Loss:
    """Why a receiver lost a frame. Powers are None if nothing arrived, or if the medium has no powers.

    Attributes:
        frame: Row of the table `frames`.
        receiver: Id of a node.
        sent_dbm: Power of the sender.
        power_dbm: Power at the receiver.
        noise_dbm: Noise at the receiver; None if the frame was too weak, whatever the noise.
        interference_dbm: Sum of the other frames at the worst moment; None if they did not matter.
        needed: Sensitivity in dBm if `noise_dbm` is None, otherwise the SINR in dB with which half of
            such frames survive, or that preamble detection needs; None on a medium without powers.
        distance_m: Distance of sender and receiver, in meters.
        path_loss_db: Path loss of the distance in dB; None on a medium without powers.
        gains: {name: dB} of what is not 0: `sender antenna`, `receiver antenna`, `ground`, `shadowing`,
            `fading`. What takes power is negative.
        obstacles: (index in the description of the run, gain in dB) of each obstacle in between.
        interferers: (id of a node, power in dBm) of those that interfered, strongest first.
    """

    frame: int
    receiver: int
    sent_dbm: float | None
    power_dbm: float | None
    noise_dbm: float | None
    interference_dbm: float | None
    needed: float | None
    distance_m: float
    path_loss_db: float | None
    gains: Mapping[str, float]
    obstacles: list[tuple[int, float]] = field(default_factory=list)
    interferers: list[tuple[int, float | None]] = field(default_factory=list)

    @cached_property
    def sinr_db(self) -> float | None:
        """Ratio of the power to noise and interference, in dB; None if it was below the sensitivity."""
        if self.power_dbm is None or self.noise_dbm is None:
            return None
        others = [power for power in (self.noise_dbm, self.interference_dbm) if power is not None]
        return self.power_dbm - 10 * math.log10(sum(10 ** (power / 10) for power in others))

    @cached_property
    def short_db(self) -> float | None:
        """How much more power was needed, in dB; None if that is not known."""
        had = self.power_dbm if self.noise_dbm is None else self.sinr_db
        return None if had is None or self.needed is None else self.needed - had

    def words(self, names: Sequence[str], obstacles: Sequence[str], sender: int) -> str:
        """Return the loss in words, from the power on.

        `names` of the nodes, and of the obstacles. `sender` is the id of the sender.
        """
        of = ", ".join(
            names[node] if power is None or len(self.interferers) == 1 else f"{names[node]} {power:.1f} dBm"
            for node, power in self.interferers
        )
        if self.needed is None:
            return f"of {of}" if of else ""
        parts = ["no power" if self.power_dbm is None else f"{self.power_dbm:.1f} dBm"]
        if self.sinr_db is not None:
            parts.append(f"SINR {self.sinr_db:.1f} dB")
        unit = "dBm" if self.noise_dbm is None else "dB"
        need, short = "needs", ""
        if self.short_db is not None and self.noise_dbm is not None and self.short_db <= 0:
            need = "half of such frames need"
        elif self.short_db is not None:
            short = f" ({self.short_db:.1f} dB short)" if self.short_db >= _SHOWN_DB else " (just short)"
        parts.append(f"{need} {self.needed:.1f} {unit}{short}")
        if self.interference_dbm is None:
            return f"{', '.join(parts)}: {self.path_words(names, obstacles, sender)}"
        return f"{', '.join(parts)}, interference {self.interference_dbm:.1f} dBm of {of}"

    def path_words(self, names: Sequence[str], obstacles: Sequence[str], sender: int) -> str:
        """Return what took the power, and what added to it: `247 m take 88.1 dB, fading 3.0 dB`."""
        words = {
            "sender antenna": f"antenna of {names[sender]}",
            "receiver antenna": f"antenna of {names[self.receiver]}",
        }
        gains = [(words.get(name, name), gain) for name, gain in self.gains.items()]
        gains += [(f"obstacle '{obstacles[index]}'", gain) for index, gain in self.obstacles]
        taken = [
            f"{name} over {-_ALL_DB:.0f} dB" if gain < _ALL_DB else f"{name} {-gain:.1f} dB"
            for name, gain in sorted(gains, key=lambda each: each[1])
            if gain < -_SHOWN_DB
        ]
        added = [f"{name} adds {gain:.1f} dB" for name, gain in gains if gain > _SHOWN_DB]
        loss = "" if self.path_loss_db is None else f" {self.path_loss_db:.1f} dB"
        sent = "" if self.sent_dbm is None else f" of {self.sent_dbm:.1f} dBm"
        return ", ".join([f"{self.distance_m:.0f} m take{loss}{sent}", *taken, *added])


_GAINS = ("sender_antenna", "receiver_antenna", "ground", "shadowing", "fading")


def losses_of(chunk: Chunk) -> Iterator[Loss]:
    """Yield the losses of a chunk, by frame."""
    table, frames = chunk.tables["losses"], chunk.tables["frames"]
    if not table["frame"]:
        return
    paths = Paths(chunk)
    obstacles = _by_reception(chunk, "obstructions", "obstacle", "gain_cdb")
    interferers = _by_reception(chunk, "interferers", "node", "power_cdbm")
    for row, frame in enumerate(table["frame"]):
        receiver, start_ns = table["receiver"][row], frames["time_ns"][frame]
        positions = (paths.position(node, start_ns) for node in (frames["node"][frame], receiver))
        sent_dbm = _dbm(frames["power_cdbm"][frame])
        power_dbm = _dbm(table["power_cdbm"][row])
        gains = {name.replace("_", " "): table[f"{name}_cdb"][row] / 100 for name in _GAINS}
        crossed = [(index, gain / 100) for index, gain in obstacles.get((frame, receiver), ())]
        path_loss_db = None
        if sent_dbm is not None:
            rest_db = sum(gains.values()) + sum(gain for _, gain in crossed)
            path_loss_db = (
                -table["distance_cdb"][row] / 100 if power_dbm is None else sent_dbm + rest_db - power_dbm
            )
        yield Loss(
            frame,
            receiver,
            sent_dbm,
            power_dbm,
            _dbm(table["noise_cdbm"][row]),
            _dbm(table["interference_cdbm"][row]),
            None if sent_dbm is None else table["needed_cdb"][row] / 100,
            math.dist(*positions),
            path_loss_db,
            {name: gain for name, gain in gains.items() if gain},
            crossed,
            [(node, _dbm(power)) for node, power in interferers.get((frame, receiver), ())],
        )


def _by_reception(chunk: Chunk, table: str, *columns: str) -> dict[tuple[int, int], list[Any]]:
    """Return {(frame, receiver): rows of the columns}."""
    found: dict[tuple[int, int], list[Any]] = {}
    for frame, receiver, *values in chunk.rows(table, "frame", "receiver", *columns):
        found.setdefault((frame, receiver), []).append(tuple(values))
    return found


def _dbm(power_cdbm: int) -> float | None:
    return None if power_cdbm == NO_POWER else power_cdbm / 100
