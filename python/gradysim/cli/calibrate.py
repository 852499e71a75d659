"""`gradysim calibrate`: the transmission power for a range."""

import math
import sys
from decimal import ROUND_CEILING, Context
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from gradysim.cli.errors import OK, report_error
from gradysim.cli.options import ConfigOption, FileArgument, SetOption, option_value
from gradysim.cli.runs import check
from gradysim.integrated.calibration import Calibration, calibrate, pair_of
from gradysim.integrated.compiled_part import CompiledPartMissingError
from gradysim.integrated.fitted_path_loss import fit_path_loss, read_measurements
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.parse.units import db_from_ratio, dbm_from_w
from gradysim.scenario.resolve.sweep import text_of_iterations
from gradysim.scenario.scenario import Scenario
from gradysim.scenario.schema.parameter_types import quantity, whole_bytes

if TYPE_CHECKING:
    from matplotlib.figure import Figure

BAR_WIDTH = 40


def calibrate_power(
    file: FileArgument,
    /,
    *,
    config: ConfigOption = "General",
    range_text: Annotated[
        str | None,
        Parameter(name="--range", allow_leading_hyphen=True, help="The wanted range, such as 50m."),
    ] = None,
    measurements: Annotated[
        Path | None,
        Parameter(
            name="--from",
            help="Fit path loss and shadowing instead: a CSV file with the columns distance_m and rssi_dbm"
            " (measured powers), or distance_m and delivered (0 or 1 for each frame).",
        ),
    ] = None,
    ratio: Annotated[float, Parameter(help="Ratio of frames received at that range.")] = 0.5,
    message: Annotated[
        str, Parameter(allow_leading_hyphen=True, help="Length of the message in a frame.")
    ] = "50B",
    sender: Annotated[
        str | None,
        Parameter(help="Sending node, or its interface (relay.wlan[1]); by default the first node."),
    ] = None,
    receiver: Annotated[
        str | None,
        Parameter(help="Receiving node, or its interface; by default a copy of the sender."),
    ] = None,
    picture: Annotated[
        Path | None, Parameter(help="Draw reception over distance into this file (.png, .svg, .pdf).")
    ] = None,
    settings: SetOption = (),
) -> int:
    """Carry out `gradysim calibrate`, and return the exit code."""
    try:
        scenario = check(file, config, "0", settings)[0]
        if not 0 < ratio < 1:
            hint = f"; did you mean {ratio / 100:g}?" if 1 < ratio < 100 else ""
            raise ConfigError(
                f"--ratio {ratio:g}: it is out of range; expected more than 0 and less than 1{hint}"
            )
        if (range_text is None) == (measurements is None):
            raise ConfigError("calibrate: expected either --range or --from")
        if measurements is not None and picture is not None:
            raise ConfigError("--from: there is no picture of a fit; expected no --picture")
        message_bytes = int(option_value("--message", message, whole_bytes()))
        if measurements is not None:
            print(_text_of_fit(scenario, measurements, sender, receiver, message_bytes))
            return OK
        assert range_text is not None
        if picture is not None:
            check_picture(picture)
        found = calibrate(
            scenario,
            range_m=float(option_value("--range", range_text, quantity("m", above=0))),
            ratio=ratio,
            message_bytes=message_bytes,
            sender=sender,
            receiver=receiver,
        )
        if scenario.iterations:
            print(f"of the runs of {config} this is run 0, {text_of_iterations(scenario.iterations)}")
        print(text_of_calibration(found, sys.stdout.encoding or "utf-8"))
        if picture is not None:
            draw(found, picture)
            print(f"drawn in {picture}")
    except (ConfigError, CompiledPartMissingError, ImportError, ValueError, OSError) as error:
        return report_error(error)
    return OK


def _text_of_fit(
    scenario: Scenario, file: Path, sender: str | None, receiver: str | None, message_bytes: int
) -> str:
    pair = pair_of(scenario, sender, receiver)
    fitted = fit_path_loss(scenario, read_measurements(file), *pair, message_bytes)
    alpha, loss, deviation, half = fitted.alpha, fitted.loss_db, fitted.deviation_db, fitted.half_m
    at_half = (
        [f"half of the frames arrive at {half.value:.4g} m   # {half.low:.4g} to {half.high:.4g}"]
        if half
        else []
    )
    lines = [
        f"{fitted.measurements:,} measurements, {fitted.nearest_m:g} m to {fitted.farthest_m:g} m; each value"
        " has its interval of 95 %",
        *at_half,
        "",
        '    *.radioMedium.pathLoss.typename = "FreeSpacePathLoss"',
        f"    *.radioMedium.pathLoss.alpha = {alpha.value:.2f}   # "
        + ("not fitted" if half else f"{alpha.low:.2f} to {alpha.high:.2f}"),
        f"    *.radioMedium.pathLoss.systemLoss = {max(loss.value, 0):.1f}dB"
        f"   # {loss.low:.1f} to {loss.high:.1f}",
        f"    *.radioMedium.shadowing.standardDeviation = {deviation.value:.1f}dB"
        f"   # {deviation.low:.1f} to {deviation.high:.1f}",
    ]
    if loss.value < 0:
        above = f"The powers are {-loss.value:.1f} dB above those of the file"
        lines += ["", f"{above}: raise `transmitter.power` or `antenna.gain`."]
    return "\n".join(lines)


def text_of_calibration(calibration: Calibration, encoding: str = "utf-8") -> str:
    """Return the report, for an output of that encoding."""
    c = calibration
    above = (
        f"{db_from_ratio(c.snr_at_range):.2f} dB above the" if math.isfinite(c.snr_at_range) else "without"
    )
    wlan = "wlan[*]" if c.sender_interfaces == 1 else f"wlan[{c.sender_interface}]"
    lines = [
        f"{_sender(c)} to {_receiver(c)}: {c.ratio:.12g} of the broadcast frames are received at"
        f" {c.range_m:.12g} m",
        f"if no other node sends ({c.message_bytes} B of message, {c.frame_bytes} B in all, at"
        f" {c.bitrate_bps / 1e6:g} Mbps;",
        f"{above} noise), with a power of {_in_dbm(c.tx_power_w)} dBm:",
        "",
        f"    *.{c.sender}.{wlan}.radio.transmitter.power = {_in_mw(c.tx_power_w)}mW",
        *_what_bitrate(c),
        "",
        *_what_is_beyond_radios(c.tx_power_w),
        *_what_decides("sensitivity", c.deciding_sensitivity_w),
        *_what_decides("preambleDetection.minimumPower", c.deciding_preamble_w),
        *_what_is_left_out(c.obstacles_left_out),
        "distance   received",
    ]
    block = "█" if "█".encode(encoding, errors="ignore") else "#"
    for distance_m, ratio in c.curve:
        bar = block * round(ratio * BAR_WIDTH)
        lines.append(f"{_in_metres(distance_m):>6} m  {100 * ratio:7.2f} %  {bar}".rstrip())
    return "\n".join(lines)


def _what_bitrate(c: Calibration) -> list[str]:
    """Return a note if the line above is not what sets the power."""
    if not c.is_of_bitrate:
        return []
    bitrate = f"{c.bitrate_bps / 1e6:g}Mbps"
    return [f"    # or in transmitter.powerByBitrate, which counts: [{bitrate}, {_in_mw(c.tx_power_w)}mW]"]


_STRONGEST_W = 1.0
"""Radios of vehicles have less, and the rules for most bands do not allow more."""


def _what_is_beyond_radios(power_w: float) -> list[str]:
    """Return a warning about a power that no radio of a vehicle has."""
    if power_w <= _STRONGEST_W:
        return []
    return [
        f"warning: this is {power_w:.3g} W, more than radios of vehicles have ({_STRONGEST_W:g} W);",
        "expected a smaller --range, a lower bitrate or another path loss",
        "",
    ]


def _sender(c: Calibration) -> str:
    """Return its name, with its interface unless it is the first one. Receivers have the same form."""
    return f"{c.sender}.wlan[{c.sender_interface}]" if c.sender_interface else c.sender


def _receiver(c: Calibration) -> str:
    return "another one like it" if c.receiver == c.sender else c.receiver


def _in_mw(power_w: float) -> str:
    """Return six digits, rounded up: with less than the sensitivity, nothing is received."""
    rounded_w = Context(prec=6, rounding=ROUND_CEILING).create_decimal(repr(power_w))
    return f"{float(rounded_w.scaleb(3)):.6g}"


def _in_dbm(power_w: float) -> str:
    """Return three digits after the point, rounded up."""
    return f"{math.ceil(1000 * dbm_from_w(power_w)) / 1000:.3f}"


def _in_metres(distance_m: float) -> str:
    """Return five digits, or all digits before the point."""
    return f"{distance_m:.5g}" if distance_m < 99_999.5 else f"{distance_m:.0f}"


def _what_decides(level: str, level_w: float | None) -> list[str]:
    if level_w is None:
        return []

    decides = (
        f"The receiver's {level} of {dbm_from_w(level_w):g} dBm decides, not the noise:"
        " no slower bitrate would do with less power."
    )
    return [*wrap(decides, width=88), ""]


def _what_is_left_out(obstacles: int) -> list[str]:
    if not obstacles:
        return []
    these = "The obstacle is" if obstacles == 1 else f"The {obstacles:,} obstacles are"
    return [f"{these} left out: nothing stands in between.", ""]


def check_picture(path: Path) -> None:
    """Check the file of a picture before the calculation.

    Raises:
        ImportError: matplotlib is missing; the message says how to install it.
        ValueError: The suffix is not a format, the directory does not exist, or the file is a directory.
    """
    if path.suffix[1:].lower() not in _figure().canvas.get_supported_filetypes():
        problem = f"`{path.suffix}` is not a format" if path.suffix else "its name does not end in a format"
        raise ValueError(f"--picture {path}: {problem}; expected .png, .svg or .pdf")
    if not path.parent.is_dir():
        raise ValueError(
            f"--picture {path}: the directory {path.parent} does not exist; expected an existing one"
        )
    if path.is_dir():
        raise ValueError(f"--picture {path}: it is a directory; expected a file")


def draw(calibration: Calibration, path: Path) -> None:
    """Draw reception over distance into a file. Its suffix chooses the format.

    Raises:
        ImportError: matplotlib is missing; the message says how to install it.
        ValueError: The suffix is not a format.
        OSError: The file, which the error names, cannot be written.
    """
    c = calibration
    figure = _figure()
    axes = figure.subplots()
    axes.plot([0.0, *(d for d, _ in c.fine_curve)], [c.curve[0][1], *(r for _, r in c.fine_curve)])
    axes.axvline(c.range_m, linestyle=":", color="gray")
    axes.axhline(c.ratio, linestyle=":", color="gray")
    axes.set(xlabel="distance (m)", ylabel="share of frames received", ylim=(-0.02, 1.02), xlim=(0, None))
    axes.set_title(f"{_sender(c)} to {_receiver(c)}, {_in_mw(c.tx_power_w)} mW, {c.bitrate_bps / 1e6:g} Mbps")
    try:
        figure.savefig(path)
    except OSError as error:
        error.filename = str(path)  # missing if the disk is full
        raise


def _figure() -> "Figure":
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        raise ImportError("a picture needs matplotlib: pip install matplotlib") from error
    return Figure(figsize=(6, 4), dpi=120, layout="constrained")
