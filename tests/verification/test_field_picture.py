"""The picture of docs/verification/field.md."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.motion.flight_controller import Airframe
from gradysim.scenario import Scenario
from verification.test_field import (
    CISCO_DB,
    FIELD_LEGS_S,
    NOISE_DBM,
    POWERS_DBM,
    SENSITIVITIES_DBM,
    TWIN_LEGS_S,
    duration_s,
    loaded,
    snr_db,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["loaded"]


def test_picture(
    picture: Callable[[str, Callable[[Path], None]], None], loaded: Callable[..., Scenario]
) -> None:
    levels_db = {mbps: snr_db(loaded, mbps) for mbps in CISCO_DB}
    picture("field.png", lambda path: draw(path, levels_db))


def draw(path: Path, levels_db: dict[int, float]) -> None:
    from verification.figure import MODEL, OURS, save

    def bitrates(axes: "Axes") -> None:
        axes.plot(list(levels_db), list(levels_db.values()), color=OURS, lw=1.2, label="engine")
        axes.plot(list(CISCO_DB), list(CISCO_DB.values()), "o", color=MODEL, ms=4, label="Cisco")
        axes.set(xlabel="bitrate (Mbps)", ylabel="signal over noise (dB)")
        axes.set_title("what each bitrate needs: nothing fitted", fontsize=9)
        axes.legend(fontsize=7.5)

    def sensitivities(axes: "Axes") -> None:
        for marker, (device, printed) in zip("osD^", SENSITIVITIES_DBM.items(), strict=True):
            offsets = [level - NOISE_DBM - levels_db[mbps] for mbps, level in printed.items()]
            figure_db = sum(offsets) / len(offsets)
            engine = [NOISE_DBM + figure_db + levels_db[mbps] for mbps in printed]
            (line,) = axes.plot(list(printed), engine, lw=1.2, label=f"{device}, {figure_db:.1f} dB")
            axes.plot(list(printed), list(printed.values()), marker, color=line.get_color(), ms=4)
        axes.set(xlabel="bitrate (Mbps)", ylabel="sensitivity (dBm)")
        axes.set_title("sensitivities: a noise figure fitted to each", fontsize=9)
        axes.legend(fontsize=7.5)

    def legs(axes: "Axes") -> None:
        lengths_m = range(6, 86, 2)
        for label, measured, color, wait_s, speed_mps, airframe in (
            ("in the field", FIELD_LEGS_S, OURS, 0.55, 4.5, Airframe(1.0)),
            ("simulated autopilot", TWIN_LEGS_S, MODEL, 0.73, 10.0, Airframe()),
        ):
            times_s = [wait_s + duration_s(leg_m, speed_mps, airframe) for leg_m in lengths_m]
            axes.plot(lengths_m, times_s, color=color, lw=1.2, label=f"engine, {label}")
            axes.plot(list(measured), list(measured.values()), "o", color=color, ms=4, label=label)
        axes.set(xlabel="length of a leg (m)", ylabel="time (s)")
        axes.set_title("legs of a copter: start and acceleration fitted", fontsize=9)
        axes.legend(fontsize=7.5)

    def powers(axes: "Axes") -> None:
        distances_m = [4 * 1.03**step for step in range(60)]
        for sent_dbm, measured in POWERS_DBM.items():
            at_one_metre_dbm = sent_dbm - 13.5 - 20 * math.log10(4 * math.pi * 2.412e9 / 299_792_458)
            engine = [at_one_metre_dbm - 20 * math.log10(distance_m) for distance_m in distances_m]
            (line,) = axes.semilogx(distances_m, engine, lw=1.2, label=f"{sent_dbm} dBm")
            axes.semilogx(list(measured), list(measured.values()), "o", color=line.get_color(), ms=4)
        axes.set_xticks([5, 10, 15, 20], ["5", "10", "15", "20"], minor=False)
        axes.xaxis.set_minor_formatter("")
        axes.set(xlabel="distance (m)", ylabel="received power (dBm)")
        axes.set_title("power over distance: one loss fitted to 0, 10, 20 dBm", fontsize=9)
        axes.legend(fontsize=7.5)

    save(path, "Engine (lines) and measurements (points)", bitrates, sensitivities, powers, legs, columns=2)
