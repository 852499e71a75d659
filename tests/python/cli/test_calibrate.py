"""`gradysim calibrate`: with the printed line, a run has the promised receptions."""

import math
import re
from collections.abc import Callable
from pathlib import Path
from random import Random

import pytest

pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")

from gradysim.cli.app import main
from gradysim.integrated.run import run
from gradysim.scenario import load_scenarios
from python.thorough import some

INI = """[General]
*.sender.protocol.typename = "BeaconProtocol"
*.sender.protocol.payload_bytes = 50
*.sender.protocol.interval = 5ms
*.receiver.protocol.typename = "BeaconProtocol"
*.receiver.protocol.stop = 0s
**.mobility.typename = "StationaryMobility"
**.mobility.telemetryInterval = 0s
**.mobility.initialZ = 3m
"""

PATH_LOSS = "*.radioMedium.pathLoss.typename"
NOISE_DECIDES = ("**.radio.receiver.sensitivity = -150dBm",)

Received = Callable[..., float]


@pytest.fixture
def received(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Received:
    """`received(200.0, 0.5, 2000, *settings)`: ratio of 2000 frames at 200 m, calibrated for one half.

    With `unit="dBm"` the power is the printed one in dBm.
    """
    file = tmp_path / "pair.ini"

    def share(range_m: float, ratio: float, frames: int, *settings: str, unit: str = "mW") -> float:
        lines = (
            f"*.receiver.mobility.initialX = {0.6 * range_m!r}m",
            f"*.receiver.mobility.initialY = {0.8 * range_m!r}m",
            f"*.sender.protocol.stop = {1 + 0.005 * (frames - 0.5)!r}s",
            f"sim-time-limit = {1 + 0.005 * (frames + 1)!r}s",
        )
        file.write_text("\n".join([INI, *settings, *lines]), encoding="utf-8")
        options = f"--range {range_m!r}m --ratio {ratio} --sender sender --receiver receiver"
        assert main(["calibrate", str(file), *options.split()]) == 0
        printed = capsys.readouterr().out
        (line,) = re.findall(r"^    (\S+ = \S+mW)$", printed, re.MULTILINE)
        if unit == "dBm":
            (power_dbm,) = re.findall(r"with a power of (\S+) dBm", printed)
            line = f"{line.partition(' = ')[0]} = {power_dbm}dBm"
        (scenario,) = load_scenarios(file, overrides=[line])
        sender, receiver = (node.tracked_variables for node in run(scenario).nodes)
        assert sender["sent"] == frames
        return float(receiver["received"]) / frames

    return share


@pytest.mark.parametrize("unit", ["mW", "dBm"])
@pytest.mark.parametrize("mbps", [6, 54])
@pytest.mark.parametrize(
    "path_loss",
    some(["TwoRayInterference", "FreeSpacePathLoss", "BreakpointPathLoss", "TwoRayGroundReflection"]),
)
def test_where_the_sensitivity_decides_the_power_is_enough_at_every_range(
    received: Received, path_loss: str, mbps: int, unit: str
) -> None:
    settings = f'{PATH_LOSS} = "{path_loss}"', f"**.wlan[*].bitrate = {mbps}Mbps"
    deaf_at = [
        range_m
        for range_m in (round(0.9 * 1.75**step, 2) for step in range(20))
        if not received(range_m, 0.5, 2, *settings, unit=unit)
    ]
    assert deaf_at == []


FADING = [
    ("RayleighFading", ""),
    ("NakagamiFading", "shapeFactor = 0.5"),
    ("NakagamiFading", "shapeFactor = 1"),
    ("NakagamiFading", "shapeFactor = 3"),
    ("RicianFading", "k = 8dB"),
    ("LogNormalShadowing", "sigma = 6"),
]


@pytest.mark.parametrize("decides", [(), NOISE_DECIDES], ids=["sensitivity", "noise"])
@pytest.mark.parametrize("ratio", [0.05, 0.5, 0.95])
@pytest.mark.parametrize(("path_loss", "parameter"), FADING)
def test_with_fading_the_promised_share_is_received(
    received: Received, path_loss: str, parameter: str, ratio: float, decides: tuple[str, ...]
) -> None:
    settings = [f'{PATH_LOSS} = "{path_loss}"', "*.radioMedium.pathLoss.coherenceTime = 0s", *decides]
    if parameter:
        settings.append(f"*.radioMedium.pathLoss.{parameter}")
    frames = 4000
    standard_error = math.sqrt(ratio * (1 - ratio) / frames)
    assert received(100.0, ratio, frames, *settings) == pytest.approx(ratio, abs=4.5 * standard_error)


@pytest.mark.parametrize("ratio", [0.05, 0.5, 0.95])
@pytest.mark.parametrize("mbps", [6, 24, 54])
def test_where_the_noise_decides_the_promised_share_is_received(
    received: Received, mbps: int, ratio: float
) -> None:
    frames = 4000
    standard_error = math.sqrt(ratio * (1 - ratio) / frames)
    threshold = "**.radio.receiver.snirThreshold = -20dB"
    share = received(100.0, ratio, frames, *NOISE_DECIDES, threshold, f"**.wlan[*].bitrate = {mbps}Mbps")
    assert share == pytest.approx(ratio, abs=4.5 * standard_error)


@pytest.mark.parametrize("decides", [(), NOISE_DECIDES], ids=["sensitivity", "noise"])
def test_with_the_lines_of_measured_deliveries_half_arrive_at_the_fitted_distance(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], decides: tuple[str, ...]
) -> None:
    frames = 4000
    random = Random(1)
    distances = [random.uniform(10, 200) for _ in range(1000)]
    lines = [f"{each},{int(random.gauss(0, 4) < 20 * math.log10(80 / each))}" for each in distances]
    (tmp_path / "frames.csv").write_text("\n".join(["distance_m,delivered", *lines]), encoding="utf-8")
    file = tmp_path / "pair.ini"
    stop = f"*.sender.protocol.stop = {1 + 0.005 * (frames - 0.5)!r}s\nsim-time-limit = 22s"
    file.write_text("\n".join([INI, *decides, stop]), encoding="utf-8")
    options = f"--from {tmp_path}/frames.csv --sender sender --receiver receiver"
    assert main(["calibrate", str(file), *options.split()]) == 0
    printed = capsys.readouterr().out
    (half_m,) = re.findall(r"^half of the frames arrive at (\S+) m", printed, re.MULTILINE)
    assert float(half_m) == pytest.approx(80, rel=0.1)
    found = re.findall(r"^    (\S+ = \S+)", printed, re.MULTILINE)
    assert len(found) == 4
    independent = "*.radioMedium.shadowing.decorrelationTime = 0s"
    place = f"*.receiver.mobility.initialX = {half_m}m"
    (scenario,) = load_scenarios(file, overrides=[*found, independent, place])
    sender, receiver = (node.tracked_variables for node in run(scenario).nodes)
    assert sender["sent"] == frames
    # Printed to 0.1 dB, which is 0.05 / 4 standard deviations, at most 0.5 % of the frames.
    tolerance = 0.005 + 4.5 * math.sqrt(0.25 / frames)
    assert float(receiver["received"]) / frames == pytest.approx(0.5, abs=tolerance)


@pytest.mark.parametrize(("range_m", "is_warned"), [(500, False), (500_000, True)])
def test_a_power_beyond_that_of_radios_is_a_warning(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], range_m: int, is_warned: bool
) -> None:
    file = tmp_path / "pair.ini"
    file.write_text(f"{INI}\nsim-time-limit = 1s\n", encoding="utf-8")
    options = f"--range {range_m}m --sender sender --receiver receiver"
    assert main(["calibrate", str(file), *options.split()]) == 0
    assert ("vehicles" in capsys.readouterr().out) == is_warned
