"""What becomes of single lines."""

from collections.abc import Callable

import pytest

from gradysim.omnetpp_import import Action, Outcome
from gradysim.omnetpp_import.tables import NO_MEANING, NO_NODE_TYPE, NO_RADIO_TYPE, NOT_MODELLED

REASON = {
    name: reason
    for table in (NO_MEANING, NOT_MODELLED)
    for reason, names in table.items()
    for name in names.split()
}

FirstOutcome = Callable[..., Outcome]


@pytest.mark.parametrize(
    "line",
    [
        "repeat = 3",
        'description = "a few words"',
        "*.numSensors = 2",
        "*.quads[*].mobility.speed = ${speed=5mps, 10mps}",
        "*.quads[0].mobility.initialX = uniform(0m, 1km)",
        "*.*[*].wlan[*].radio.*.sensitivity = -85dBm",
        "**.wlan[1].bitrate = 6Mbps",
        "**.quads[0].wlan[*].radio.channelNumber = 3",
        '*.radioMedium.pathLoss.typename = "TwoRayInterference"',
        "**.wlan[*].mac.*.rateSelection.multicastFrameBitrate = 6Mbps",
    ],
)
def test_kept(outcome: FirstOutcome, line: str) -> None:
    found = outcome(line)
    assert (found.action, found.text) == (Action.KEPT, line)


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("*.numUAVs = ${1, 2}", "*.numQuads = ${1, 2}"),
        ("**.wlan[*].mac.*.rateSelection.dataFrameBitrate = 6Mbps", "**.wlan[*].bitrate = 6Mbps"),
        (
            "*.quads[0].wlan[0].mac.dcf.rateSelection.dataFrameBitrate = 6Mbps",
            "*.quads[0].wlan[0].bitrate = 6Mbps",
        ),
        (
            "**.transmitter.analogModel.communicationRange = 60m",
            "**.transmitter.communicationRange = 60m",
        ),
        ("*.quads[*].mobility.telemetryFrequency = 2s", "*.quads[*].mobility.telemetryInterval = 2s"),
        (
            '*.quads[*].mobility.typename = ${"DroneMobility", "CircleMobility"}',
            '*.quads[*].mobility.typename = ${"MasslessMobility", "CircleMobility"}',
        ),
        (
            '*.radioMedium.typename = "Ieee80211RadioMedium"',
            '*.radioMedium.typename = "Ieee80211ScalarRadioMedium"',
        ),
        (
            '*.quads[*].wlan[*].radio.signalAnalogRepresentation = "unitDisk"',
            '*.radioMedium.typename = "UnitDiskRadioMedium"',
        ),
        ('**.radio.typename = "Ieee80211UnitDiskRadio"', '*.radioMedium.typename = "UnitDiskRadioMedium"'),
    ],
)
def test_renamed(outcome: FirstOutcome, before: str, after: str) -> None:
    found = outcome(before)
    assert (found.action, found.text) == (Action.RENAMED, after)


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ("cmdenv-express-mode = true", "only OMNeT++ reads it"),
        ("*.visualizer.x.displayRoutes = true", "only OMNeT++ reads it"),
        ("*.quads[*].wlan[0].radioVisualizer.antennaLobeStep = 1deg", REASON["visualizer"]),
        ('**.arp.typename = "GlobalArp"', REASON["arp"]),
        ("**.*Port = 1000", REASON["app"]),
        ('*.quads[*].app[0].destAddresses = "quads[0]"', REASON["app"]),
        ("*.quads[*].numFailures = 0", REASON["numFailures"]),
        ('**.wlan[*].mac.typename = "Ieee80211Mac"', REASON["mac"]),
        (
            '*.radioMedium.signalAnalogRepresentation = ${"scalar"}',
            REASON["signalAnalogRepresentation"],
        ),
        ('*.quads[*].typename = "AdhocHost"', NO_NODE_TYPE),
        ("*.quads[*].mobility.constraintAreaMinX = 0m", "nothing limits the area"),
        ('**.wlan[*].radio.typename = "Ieee80211ScalarRadio"', "say what its radio is"),
        ("*.quads[*].mobility.initialAltitude = 5m", "without coordinateSystemModule"),
    ],
)
def test_left_out(outcome: FirstOutcome, line: str, reason: str) -> None:
    found = outcome(line)
    assert (found.action, found.text) == (Action.LEFT_OUT, "")
    assert reason in found.note


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ('**.wlan[*].mac.typename = "XMac"', REASON["mac"]),
        ('**.wlan[*].mac.typename = ${"Ieee80211Mac", "BMac"}', REASON["mac"]),
        ("*.host*.wlan[0].mac.ackTimeout = 300us", REASON["mac"]),
        ("*.*.wlan[*].mac.hcf.isBlockAckSupported = true", REASON["hcf"]),
        ('*.radioMedium.signalAnalogRepresentation = "dimensional"', REASON["frequencyGains"]),
        ('*.radioMedium.typename = "Ieee80211DimensionalRadioMedium"', "expected one of"),
        ('*.*.wlan[0].radio.typename = "Ieee80211DimensionalRadio"', NO_RADIO_TYPE),
        ('*.*.wlan[0].radio.transmitter.frequencyGains = "left right"', REASON["frequencyGains"]),
        ("*.radioMedium.backgroundNoise.powerSpectralDensity = -110dBmWpMHz", "noise has a power"),
        ('*.radioMedium.pathLoss.typename = ${"TwoRayNewModel", "FreeSpacePathLoss"}', "expected one of"),
        ("*.host*.wlan[0].radio.receiver.ignoreInterference = true", "there is no such parameter"),
        ('*.source.wlan[*].radio.antenna.gains = "0 1"', "there is no such parameter"),
        ("*.noiseSource.transmitter.power = 1mW", REASON["noiseSource"]),
        ("*.sensor*.wlan[0].radio.energyConsumer.offPowerConsumption = 0mW", REASON["energyConsumer"]),
        ("*.quads[*].numFailures = 1", REASON["numFailures"]),
        ('*.host*.typename = "AodvRouter"', NO_NODE_TYPE),
        ("*.coordinateSystem.sceneHeading = 90deg", "x is North"),
        ("*.quads[*].mobility.initialColor = 5", "there is no such parameter"),
        ("warmup-period = 1s", "results are of whole runs"),
        ("no-such-option = 1s", "there is no such option"),
    ],
)
def test_not_modelled(outcome: FirstOutcome, line: str, reason: str) -> None:
    found = outcome(line)
    assert (found.action, found.text, found.is_in_force) == (Action.NOT_MODELLED, line, False)
    assert reason in found.note


@pytest.mark.parametrize(
    ("line", "text", "note"),
    [
        ('*.quads[*].mobility.waypointFile = "a.waypoints"', "", "fly-a-mission"),
        ('*.physicalEnvironment.config = xmldoc("a.xml")', '*.environment.obstacles = "FILE.geojson"', ""),
        ('*.quads[*].mobility.typename = "TurtleMobility"', "*.quads[*].mobility.typename = ...", "one of"),
        ("**.mtu = ${1000, 4000}B", "**.mtu = ...", "at most 2304B"),
        ("**.bitrate = ${rate}", "**.bitrate = ${rate}", "values of `rate`"),
    ],
)  # fmt: skip
def test_to_write(outcome: FirstOutcome, line: str, text: str, note: str) -> None:
    found = outcome(line)
    assert (found.action, found.text) == (Action.TO_WRITE, text)
    assert note in found.note


def test_an_area_is_kept_for_nodes_that_it_limits(outcome: FirstOutcome) -> None:
    line = "*.quads[*].mobility.constraintAreaMinX = 0m"
    assert outcome(line, '*.quads[0].mobility.typename = "LinearMobility"').action is Action.KEPT


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("initialLatitude = -15.841deg", "initialX = -111.195m"),
        ("homeLongitude = -46.99deg", "initialY = 1069.726m"),
        ("initialAltitude = 25m", "initialZ = 20m"),
    ],
)
def test_geographic_starts_are_relative_to_the_scene(outcome: FirstOutcome, line: str, expected: str) -> None:
    scene = ["sceneLatitude = -15.84deg", "sceneLongitude = -47deg", "sceneAltitude = 5m"]
    found = outcome(
        f"*.sensors[1].mobility.{line}",
        '*.sensor*[*].mobility.coordinateSystemModule = "coordinateSystem"',
        *(f"*.coordinateSystem.{each}" for each in scene),
    )
    assert found.text == f"*.sensors[1].mobility.{expected}"
