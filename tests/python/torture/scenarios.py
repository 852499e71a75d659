"""Random scenarios: each has a result, the same twice, in which each reception has one outcome."""

from pathlib import Path
from random import Random

from gradysim.integrated.run import run
from gradysim.scenario import load_scenarios
from gradysim.scenario.schema.keys import engine_key

PATH_LOSSES = engine_key("medium.path_loss").kind.names
RATE_CONTROLS = engine_key("mac.rate_control").kind.names
ANTENNAS = ("IsotropicAntenna", "DipoleAntenna")


def ini(random: Random) -> str:
    """Return a scenario in which senders load a channel, with broadcasts and with messages to one node."""
    side_m = random.choice([50, 300, 3000])
    return f"""
[General]
sim-time-limit = {random.uniform(0.05, 2):.3f}s
seed-set = {random.randrange(1000)}
**.mobility.initialX = uniform(0m, {side_m}m)
**.mobility.initialY = uniform(0m, {side_m}m)
**.mobility.initialZ = uniform(1m, 60m)
*.sink.protocol.typename = "SinkProtocol"
*.numBeacons = {random.randint(1, 20)}
*.beacons[*].protocol.typename = "BeaconProtocol"
*.beacons[*].protocol.interval = {random.choice([2, 10, 100])}ms
*.beacons[*].protocol.spread = {random.choice([0, 5])}ms
*.beacons[*].protocol.first_send = 1ms
*.beacons[*].protocol.payload_bytes = {random.randint(1, 1500)}
*.numSources = {random.randint(1, 6)}
*.sources[*].protocol.typename = "SaturatingSource"
*.sources[*].protocol.interval = {random.choice([1, 20])}ms
*.radioMedium.pathLoss.typename = "{random.choice(PATH_LOSSES)}"
*.radioMedium.backgroundNoise.power = {random.uniform(-115, -90):.1f}dBm
**.wlan[*].radio.transmitter.power = {random.uniform(0, 20):.1f}dBm
**.wlan[*].radio.antenna.typename = "{random.choice(ANTENNAS)}"
**.wlan[*].bitrate = {random.choice([6, 12, 24, 54])}Mbps
**.wlan[*].mac.dcf.rtsPolicy.rtsThreshold = {random.choice([0, 200, 3000])}B
**.wlan[*].mac.dcf.rateControl.typename = "{random.choice(RATE_CONTROLS)}"
**.wlan[*].radio.receiver.frameCapture.typename = "{random.choice(["", "SimpleFrameCapture"])}"
**.wlan[*].radio.receiver.preambleDetection.typename = "{random.choice(["", "ThresholdPreambleDetection"])}"
"""


def once(random: Random, folder: Path) -> int:
    """Run a random scenario twice; return 1."""
    file = folder / "scenario.ini"
    file.write_text(ini(random))
    (scenario,) = load_scenarios(file)
    result = run(scenario)
    assert result.result_hash == run(scenario).result_hash
    receivers = len(scenario.nodes) - 1
    received = {kind: sum(outcomes.values()) for kind, outcomes in result.outcomes["frames"].items()}
    messages = result.outcomes["messages"]["broadcast"]
    # At the end, each node may have a frame in the air that is not counted as sent yet.
    assert received["broadcast"] % receivers == 0
    assert messages["sent"] <= received["broadcast"] // receivers <= messages["sent"] + len(scenario.nodes)
    for kind in ("unicast", "ack", "rts", "cts"):
        assert received[f"{kind} overheard"] == (receivers - 1) * received[kind]
    return 1
