"""The wording of the messages about mistakes in scenarios, in one golden file.

To add a case, add its text to a table below, run `make golden` and read the change of
`tests/golden/messages.txt`. All other tests check the attributes of errors, not their wording.
"""

from collections.abc import Iterator
from typing import Any

from gradysim.scenario import ConfigError, load_scenarios
from python.golden import check_golden

LINES = [
    "*.uavz[*].mobility.speed = 1",
    "*.uavz[*].mobility.sped = 1",
    "*.physicalEnvironment.config = 1",
    "*.uavs[*].app[0].typename = 1",
    "**.ipv4.arp.typename = 1",
    "*.radioMedum.pathLoss.alpha = 1",
    "*.boats[*].mobility.speed = 1",
    "*.uavs[7].mobility.speed = 1",
    "*.groundStation[*].mobility.speed = 1",
    "*.numuavs = 1",
    "*.numberOfUavs = 1",
    "*.uavs.mobility.speed = 1",
    "**.wlan[0].mac.rtsThreshold = 1",
    "*.uavs[1].power = 1",
    "*.radioMedium.sigma = 1",
    "uavs[*].mobility.speed = 1",
    "*.uavs[0].wlan[0].radio.transmiter.power = 1",
    "*.uavs[*].bitrate = 1",
    "*.radioMedium.pathLoss.alfa = 1",
    "**.powr = 1",
    "n[1..2] = 1",
    "*. = 1",
    "*..uavs = 1",
    "**.radio.transmiter.power = 1",
    "**.heartbeat_jiter = 1",
    "*.uavs[*].protocol.heartbeat_jiter = 1",
    "*.uavs[*].protocol.waypoints = 1",
    "*.groundStation.protocol.label = 1",
    "*.*.protocol.lable = 1",
    "*.numUavs = two",
    "*.numUavs = -1",
    "*.numUavs = 1.5",
    "*.numUavs = ${n=1..}",
    "*.numUavz = 1",
    "*.uavs[*].numWlanInterfaces = 0",
    "*.uavs[*].mobility.speed = two",
    "*.uavs[*].mobility.speed = -1mps",
    "*.uavs[*].mobility.speed = 5",
    "*.uavs[*].mobility.speed = 5s",
    "*.uavs[*].mobility.speed = 5m/s",
    "*.uavs[*].mobility.speed = 5mp",
    "*.uavs[*].mobility.speed = 5mps + 1",
    "*.uavs[*].mobility.speed = 5mps +",
    "*.uavs[*].mobility.speed = (5mps",
    "*.uavs[*].mobility.speed = 1mps, 2mps",
    "*.uavs[*].mobility.speed = 1mps..5mps",
    "*.uavs[*].mobility.speed = unifrom(1mps, 2mps)",
    "*.uavs[*].mobility.speed = uniform(1mps)",
    "*.uavs[*].mobility.speed = uniform(1mps, 2s)",
    "*.uavs[*].mobility.speed = ${v}",
    "*.uavs[*].mobility.speed = ${v=1mps, 2mps",
    "*.uavs[*].mobility.speed = 1mps / 0",
    "*.uavs[*].mobility.speed = true",
    "*.uavs[*].mobility.initialX = 1e8m",
    '*.uavs[*].mobility.typename = "MaslessMobility"',
    "*.uavs[*].mobility.typename = MassMobility",
    '*.uavs[*].mobility.typename = "WaypointMobility"',
    "*.uavs[*].mobility.columns = 2",
    "*.uavs[*].mobility.numHosts = 1",
    "*.uavs[*].mobility.columns = 0",
    '*.uavs[*].mobility.typename = "ArduPilotMobility"\n*.uavs[*].mobility.speed = 0mps',
    "*.uavs[*].mobility.speed = -intuniform(2, 2) * 1mps",
    "*.uavs[*].mobility.speed = 3mps - 5mps * parentIndex()",
    "*.uavs[*].mobility.speed = 5\N{MICRO SIGN}s",
    "*.uavs[*].mobility.lineStartY = 1m\n*.uavs[*].mobility.lineStepY = 10000km",
    '*.numBoats = 1\n*.boats[*].protocl.class = "protocols.py:Mobile"',
    '*.uavs[*].protocol.class = "protocol.py:Mobile"',
    '*.uavs[0].protocol.class = "protocols.py:Mobil"',
    '*.uavs[0].protocol.class = "protocols.py"',
    '*.uavs[0].protocol.class = "protocols.py:Half"',
    '*.uavs[0].protocol.class = "protocols.py:Other"',
    "*.uavs[0].protocol.class = protocols.py:Mobile",
    "*.uavs[*].protocol.retries = 1.5",
    "*.uavs[*].protocol.retries = 5s",
    "*.uavs[*].protocol.label = 5",
    "*.uavs[*].protocol.eager = 1",
    '*.uavs[*].protocol.heartbeat_jitter = "x"',
    "*.uavs[*].wlan[*].bitrate = 1m",
    "*.uavs[*].wlan[*].radio.channelNumber = 36",
    "*.uavs[*].wlan[*].radio.channelNumber = 1.5",
    "*.uavs[*].wlan[1].bitrate = 1Mbps",
    '*.uavs[*].wlan[*].radio.bandName = "2.4GHz"',
    '*.radioMedium.pathLoss.typename = "FreeSpace"',
    "*.communicationMedium.failureRate = 2",
    "*.coordinateSystem.sceneLatitude = 100deg",
    "*.environment.numObstacles = x",
    '*.environment.obstacles = "buildings.geojson"',
    "*.uavs[{].mobility.speed = 1mps",
    "*.uavs[5..2].mobility.speed = 1mps",
    "network = a b",
    "network = ${n=A, B}",
    "sim-time-limt = 3s",
    "sim-time-limit = uniform(1s, 2s)",
    "numUavs = 3",
    "zzzz = 1",
    "warmup-period = 1s",
    "repeat = 0",
    "repeat = many",
    "seed-set = -1",
    "seed-set = x",
    "constraint = $x < 2",
    "*.uavs[*].mobility.speed = fast\n*.uavs[*].mobility.initialX = 3s\nsim-time-limt = 3s",
]
"""Lines of a section added to `BASE` of conftest.py; they start at line 7."""

FILES = [
    "a = 1\n; old\n",
    "a = 1\n// old\n",
    "a = 1\n  ; old\n",
    '\na = "x\n',
    "a 1\n",
    "= 1\n",
    "a = # 1\n",
    "  a = 1\n",
    "[X]\n  a = 1\n",
    "[X]\na = 1\n\n  *.uavs[*].mobility.speed = 3mps\n",
    "a = 1\n\tseed-set = 3\n",
    "[X\n",
    "[Foo X]\n",
    "[Config General]\n",
    "[Config a/b]\n",
    "[..\\a]\n",
    "[X]\n[Y]\n[Config X]\n",
    "\ninclude test.ini\n",
    "*.uavs[${n}].x = 3\n",
    "include tst.ini\n",
]
"""Whole files that are not readable."""

SECTIONS = [
    ("[ZigZag5]\n[ZigZag15]\n", "Zigzag5"),
    ("[A]\nextends = Bas\n[Base]\n", "A"),
    ("[A]\nextends = B\n[B]\nextends = A\n", "A"),
    ("[A]\nextends = A\n", "A"),
    ("[A]\nabstract = true\n[B]\nextends = A\n", "A"),
    ("[A]\nabstract = yes\n", "A"),
    ("[A]\n[B]\nextends = A, A\n", "B"),
    ("[General]\nsim-time-limit = 1s\n[X]\n", "General"),
    ("[A]\n[General]\nextends = A\n", "General"),
]
"""Whole files, and a configuration that does not run."""

ARGUMENTS: list[dict[str, Any]] = [
    {"overrides": ["repeat"]},
    {"overrides": ["*.numUavs=two"]},
    {"overrides": ["abstract=true"]},
    {"seed": -1},
    {"runs": "x"},
    {"runs": "7"},
    {"runs": "3..1"},
    {"config": "Generl"},
]
"""Arguments of `load_scenarios` for `BASE`."""


def messages(folder: Any) -> Iterator[str]:
    """Yield each case and its message."""
    base = folder.ini.read_text()
    for lines in LINES:
        yield lines + message(folder, f"{base}[X]\n{lines}\n", config="X")
    for text in FILES:
        yield text.rstrip("\n") + message(folder, text)
    for text, config in SECTIONS:
        yield text.rstrip("\n") + f"\n    (configuration {config})" + message(folder, text, config=config)
    for arguments in ARGUMENTS:
        yield str(arguments) + message(folder, base, **arguments)


def message(folder: Any, text: str, **arguments: Any) -> str:
    folder.write("test.ini", text)
    try:
        load_scenarios(folder.ini, **arguments)
    except ConfigError as error:
        told = str(error).replace(f"{folder.path}/", "").replace("\n", "\n    ")
        return f"\n    {told}\n"
    return "\n    NO ERROR\n"


def test_messages_are_those_of_the_golden_file(folder: Any) -> None:
    check_golden("messages.txt", "\n".join(messages(folder)))
