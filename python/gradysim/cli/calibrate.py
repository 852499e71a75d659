"""`gradysim calibrate`: the transmitter power for a range."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from gradysim.cli.arguments import ConfigOption, FileArgument, SetOption
from gradysim.cli.exit_code import OK, say_mistake
from gradysim.cli.scenarios import check

if TYPE_CHECKING:
    from gradysim.scenario.parameter_types import ParameterType, Scalar


def calibrate_power(
    file: FileArgument,
    /,
    *,
    config: ConfigOption = "General",
    range_text: Annotated[
        str, Parameter(name="--range", allow_leading_hyphen=True, help="The wanted range, such as 50m.")
    ],
    ratio: Annotated[float, Parameter(help="Share of the frames that is to be received there.")] = 0.5,
    message: Annotated[
        str, Parameter(allow_leading_hyphen=True, help="Length of the message in a frame.")
    ] = "50B",
    sender: Annotated[
        str | None,
        Parameter(help="Node that sends, or its interface (relay.wlan[1]); by default the first one."),
    ] = None,
    receiver: Annotated[
        str | None,
        Parameter(help="Node that receives, or its interface; by default another one like the sender."),
    ] = None,
    picture: Annotated[
        Path | None, Parameter(help="Draw reception over distance into this file (.png, .svg, .pdf).")
    ] = None,
    settings: SetOption = (),
) -> int:
    """Find the transmitter power for a wanted range under the models of a configuration."""
    from gradysim.cli import calibration
    from gradysim.integrated.calibration import calibrate
    from gradysim.integrated.compiled_part import CompiledPartMissingError
    from gradysim.scenario.errors.config_error import ConfigError
    from gradysim.scenario.parameter_types import quantity, whole_bytes
    from gradysim.scenario.sweep import text_of_iterations

    try:
        scenario = check(file, config, "0", settings).scenarios[0]
        if not 0 < ratio < 1:
            hint = f"; did you mean {ratio / 100:g}?" if 1 < ratio < 100 else ""
            raise ConfigError(
                f"--ratio {ratio:g}: it is out of range; expected more than 0 and less than 1{hint}"
            )
        if picture is not None:
            calibration.check_picture(picture)
        found = calibrate(
            scenario,
            range_m=float(option_value("--range", range_text, quantity("m", above=0))),
            ratio=ratio,
            message_bytes=int(option_value("--message", message, whole_bytes())),
            sender=sender,
            receiver=receiver,
        )
        if scenario.iterations:
            print(f"of the runs of {config} this is run 0, {text_of_iterations(scenario.iterations)}")
        print(calibration.text(found, sys.stdout.encoding or "utf-8"))
        if picture is not None:
            calibration.draw(found, picture)
            print(f"drawn in {picture}")
    except (ConfigError, CompiledPartMissingError, ImportError, ValueError, OSError) as mistake:
        return say_mistake(mistake)
    return OK


def option_value(option: str, text: str, kind: "ParameterType") -> "Scalar":
    """Return the value that an option says. Raises ConfigError, which names the option."""
    from gradysim.scenario.errors.config_error import BadValue, ConfigError
    from gradysim.scenario.expressions import parse_value

    try:
        return kind.convert(parse_value(text))
    except BadValue as error:
        raise ConfigError(
            f"{option} {text}: {error.problem}; expected {kind.expected}{error.suggestion}"
        ) from error
