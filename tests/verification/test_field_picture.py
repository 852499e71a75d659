"""The picture of docs/verification/field.md."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.motion.flight_controller import Airframe
from gradysim.scenario import Scenario
from verification.test_field import (
    BAD_FRAMES,
    CISCO_DB,
    CURVES,
    FIELD_LEGS_S,
    NOISE_DBM,
    POWERS_DBM,
    SENSITIVITIES_DBM,
    TWIN_LEGS_S,
    above_6_mbps_db,
    duration_s,
    fitted_noises,
    loaded,
    lost_frames,
    snr_db,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["loaded"]


def test_picture(
    picture: Callable[[str, Callable[[Path], None]], None], loaded: Callable[..., Scenario]
) -> None:
    levels_db = {mbps: snr_db(loaded, mbps) for mbps in CISCO_DB}
    above_db = {curves: {mbps: above_6_mbps_db(loaded, mbps, curves) for mbps in B_MBPS} for curves in CURVES}
    noise_dbm, median_dbm, sd_db = fitted_noises()
    lost = {
        "engine": lost_frames(loaded, noise_dbm, median_dbm, sd_db),
        "with constant noise": lost_frames(loaded, median_dbm),
    }
    picture("field.png", lambda path: draw(path, levels_db, above_db, lost))


B_MBPS = (1, 2, 5.5, 11)


def draw(
    path: Path,
    levels_db: dict[int, float],
    above_db: dict[str, dict[float, float]],
    lost: dict[str, dict[float, float]],
) -> None:
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
            ("in the field", FIELD_LEGS_S, OURS, 0.65, 4.5, Airframe(1.1)),
            ("simulated autopilot", TWIN_LEGS_S, MODEL, 0.73, 10.0, Airframe()),
        ):
            times_s = [wait_s + duration_s(leg_m, speed_mps, airframe) for leg_m in lengths_m]
            axes.plot(lengths_m, times_s, color=color, lw=1.2, label=f"engine, {label}")
            axes.plot(list(measured), list(measured.values()), "o", color=color, ms=4, label=label)
        axes.set(xlabel="length of a leg (m)", ylabel="time (s)")
        axes.set_title("legs of a copter: delay and acceleration fitted", fontsize=9)
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

    def slow_bitrates(axes: "Axes") -> None:
        for style, (curves, above) in zip(("-", "--", ":"), above_db.items(), strict=True):
            label = "engine" if curves == "the default" else f"with {curves} curves"
            axes.plot(list(above), list(above.values()), style, color=OURS, lw=1.2, label=label)
        axes.errorbar([1, 11], [-1.5, 1], yerr=[1.5, 1], fmt="o", color=MODEL, ms=4, label="three devices")
        axes.set(xlabel="bitrate of 802.11b (Mbps)", ylabel="needs above 6 Mbps of 802.11g (dB)")
        axes.set_title("802.11b: nothing fitted", fontsize=9)
        axes.legend(fontsize=7.5)

    def other_systems(axes: "Axes") -> None:
        for style, (label, fractions) in zip(("-", ":"), lost.items(), strict=True):
            axes.plot(list(fractions), list(fractions.values()), style, color=OURS, lw=1.2, label=label)
        axes.plot(
            list(BAD_FRAMES), list(BAD_FRAMES.values()), "o", color=MODEL, ms=4, label="airplane to hill"
        )
        axes.set(xlabel="signal (dBm, not calibrated)", ylabel="fraction of frames lost")
        axes.set_title("other systems: noise fitted to every second point", fontsize=9)
        axes.legend(fontsize=7.5)

    panels = (bitrates, sensitivities, slow_bitrates, powers, other_systems, legs)
    save(path, "Engine (lines) and measurements (points)", *panels, columns=2)
