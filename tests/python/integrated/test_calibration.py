import math
from dataclasses import replace

import pytest

pytest.importorskip("gradysim._netsim")

import itertools

from gradysim.integrated.calibration import calibrate
from gradysim.integrated.run import run
from gradysim.scenario.errors import ConfigError
from python.integrated.fading_link import link


def received_at_150_m(*settings: str) -> float:
    scenario = link("*.receivers.count = 1", "*.receivers[*].mobility.lineStartX = 147.3648m", *settings)
    sent, received = (node.tracked_variables for node in run(scenario).nodes)
    return float(received["received"]) / float(sent["sent"])


def test_half_of_the_frames_arrive_at_the_range() -> None:
    found = calibrate(link(), 150, message_bytes=100, receiver="receivers[0]")
    power = f"**.wlan[*].radio.transmitter.power = {found.tx_power_w * 1000!r}mW"
    assert received_at_150_m(power) == pytest.approx(0.5, abs=0.06)  # five standard errors of 2000 frames


def test_a_sensitivity_that_asks_for_more_power_than_the_noise_is_named() -> None:
    deaf = "**.radio.receiver.sensitivity = -85dBm"
    by_noise, by_sensitivity = calibrate(link(), 150), calibrate(link(deaf), 150)
    assert by_noise.deciding_sensitivity_w is None
    assert by_sensitivity.deciding_sensitivity_w == pytest.approx(10**-11.5)
    slow = "**.wlan[*].bitrate = 6Mbps"
    assert calibrate(link(deaf, slow), 150).tx_power_w == pytest.approx(by_sensitivity.tx_power_w)
    assert calibrate(link(slow), 150).tx_power_w < by_noise.tx_power_w / 5


def test_the_fine_curve_has_a_step_where_the_sensitivity_decides() -> None:
    found = calibrate(link("**.radio.receiver.sensitivity = -75dBm"), 150)
    points = found.fine_curve
    assert set(found.curve) <= set(points)
    pairs = list(itertools.pairwise(points))
    (step,) = [(near, far) for near, far in pairs if near[1] - far[1] > 0.02]
    assert step[1][0] - step[0][0] < 1e-6
    assert step[0][0] == pytest.approx(150)


def test_the_fine_curve_is_fine_where_it_is_steep() -> None:
    points = calibrate(link(), 150).fine_curve
    shares = [share for _, share in points]
    assert max(near - far for near, far in itertools.pairwise(shares)) < 0.02


@pytest.mark.parametrize(
    ("levels_dbm", "deciding_dbm"),
    [
        ((-85, -82), (None, -82)),
        ((-82, -85), (-82, None)),
        ((-82, -82), (-82, None)),
        ((-120, -120), (None, None)),
    ],
)
def test_of_sensitivity_and_preamble_detection_the_one_that_asks_for_more_is_named(
    levels_dbm: tuple[int, int], deciding_dbm: tuple[int | None, int | None]
) -> None:
    sensitivity_dbm, preamble_dbm = levels_dbm
    found = calibrate(
        link(
            f"**.radio.receiver.sensitivity = {sensitivity_dbm}dBm",
            '**.radio.receiver.preambleDetection.typename = "ThresholdPreambleDetection"',
            f"**.radio.receiver.preambleDetection.minimumPower = {preamble_dbm}dBm",
        ),
        150,
    )
    levels_w = found.deciding_sensitivity_w, found.deciding_preamble_w
    assert [level_w and round(10 * math.log10(level_w * 1000), 9) for level_w in levels_w] == list(
        deciding_dbm
    )


def test_a_preamble_that_nobody_has_to_detect_is_not_named() -> None:
    found = calibrate(link("**.radio.receiver.sensitivity = -85dBm"), 150)
    assert found.deciding_preamble_w is None


def test_without_noise_the_sensitivity_decides() -> None:
    settings = "**.radio.receiver.sensitivity = -85dBm", "*.radioMedium.backgroundNoise.power = 0W"
    silent, noisy = calibrate(link(*settings), 150), calibrate(link(settings[0]), 150)
    assert silent.tx_power_w == pytest.approx(noisy.tx_power_w, rel=1e-6)
    assert (silent.snr_at_range, silent.deciding_sensitivity_w) == (math.inf, noisy.deciding_sensitivity_w)


def test_a_group_is_no_node_and_one_of_its_nodes_is_suggested() -> None:
    with pytest.raises(ConfigError) as caught:
        calibrate(link(), 150, receiver="receivers")
    assert caught.value.problem.startswith("`receivers` ")
    assert caught.value.expected.endswith(" receivers[0]")


def test_the_curve_goes_on_to_twice_the_range_and_falls() -> None:
    curve = calibrate(link(), 150).curve
    assert curve[-1][0] == pytest.approx(300)
    ratios = [ratio for _, ratio in curve]
    assert ratios == sorted(ratios, reverse=True)
    assert dict(curve)[150] == pytest.approx(0.5, abs=1e-6)


def test_the_curve_goes_through_what_was_promised_at_the_range_where_it_falls_to_nothing() -> None:
    scenario = link("**.radio.receiver.sensitivity = -85dBm")
    for step in range(40):
        range_m = 0.7 * 1.37**step
        at_range, beyond = calibrate(scenario, range_m).curve[19:21]
        assert at_range[0] == pytest.approx(range_m)
        assert (at_range[1], beyond[1]) == (1, 0)


TWO_RAYS = '*.radioMedium.pathLoss.typename = "TwoRayInterference"'


def test_two_rays_that_cancel_are_why_no_power_reaches_a_range() -> None:
    with pytest.raises(ConfigError, match="; with TwoRayInterference, "):
        calibrate(link(TWO_RAYS, "*.sender.mobility.initialZ = 0m"), range_m=50.0)


def test_rays_that_do_not_cancel_are_not_why_no_power_reaches_a_range() -> None:
    deaf = '**.antenna.typename = "ConstantGainAntenna"', "**.antenna.gain = -300dB"
    with pytest.raises(ConfigError, match="power") as error:
        calibrate(link(TWO_RAYS, *deaf), range_m=50.0)
    assert "ground" not in str(error.value)


TWO_INTERFACES = ("*.sender.numWlanInterfaces = 2", "*.sender.wlan[0].radio.channelNumber = 6")


def test_an_interface_may_be_named() -> None:
    one, two = link(), link(*TWO_INTERFACES)
    receiver = one.nodes[-1].name
    of_one = calibrate(one, 50, sender="sender", receiver=receiver)
    of_two = calibrate(two, 50, sender="sender.wlan[1]", receiver=f"{receiver}.wlan[0]")
    assert of_two == replace(of_one, sender_interfaces=2, sender_interface=1)
    back = calibrate(two, 50, sender=receiver, receiver="sender.wlan[1]")
    assert (back.sender_interface, back.receiver) == (0, "sender.wlan[1]")


def test_interfaces_of_different_channels_are_told_with_one_to_try() -> None:
    scenario = link(*TWO_INTERFACES)
    text = r"the channel of sender; expected interfaces of one channel, such as sender\.wlan\[1\]"
    with pytest.raises(ConfigError, match=text):
        calibrate(scenario, 50, sender="sender", receiver=scenario.nodes[-1].name)


@pytest.mark.parametrize(
    ("options", "text"),
    [
        ({"sender": "sender.wlan[1]"}, r"`sender.wlan\[1\]` .* interface; .* wlan\[0\]$"),
        ({"sender": "reciever"}, "`reciever` .* `receivers"),
        ({"receiver": "sender"}, "^`sender` .* receiver:"),
        ({"sender": "receivers[0]", "receiver": "receivers[0]"}, r"`receivers\[0\]` .* receiver:"),
        ({"range_m": 0.0}, "range_m = 0 m: "),
        ({"ratio": 1.0}, "ratio = 1: "),
        ({"message_bytes": 3000}, r" 3000B .* 2276B, .* wlan\[\*\]\.mac\.mtu = 2304B"),
    ],
)
def test_a_mistake_is_named(options: dict[str, object], text: str) -> None:
    with pytest.raises(ConfigError, match=text):
        calibrate(link(), **{"range_m": 50.0, **options})  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("options", "text"),
    [
        ({"range_m": "50m"}, "range_m = '50m': expected a number of meters"),
        ({"ratio": None}, "ratio = None: expected a number"),
        ({"message_bytes": 1.5}, r"message_bytes = 1\.5: expected an integer"),
        ({"sender": 0}, "sender = 0: expected the name of a node or interface"),
        ({"receiver": 0}, "receiver = 0: expected the name of a node or interface"),
    ],
)
def test_an_argument_of_another_type_is_named(options: dict[str, object], text: str) -> None:
    with pytest.raises(TypeError, match=f"^{text}$"):
        calibrate(link(), **{"range_m": 50.0, **options})  # type: ignore[arg-type]


def test_a_message_longer_than_the_mtu_is_an_error_at_its_line() -> None:
    with pytest.raises(ConfigError) as error:
        calibrate(link("**.mac.mtu = 40B"), 50)
    assert error.value.key == "**.mac.mtu"


def test_a_medium_without_powers_is_refused() -> None:
    with pytest.raises(ConfigError, match="UnitDiskRadioMedium"):
        calibrate(link('*.radioMedium.typename = "UnitDiskRadioMedium"'), 50)


def test_heights_count() -> None:
    settings = ('*.radioMedium.pathLoss.typename = "TwoRayGroundReflection"',)
    scenario = link(*settings)
    low = replace(scenario.nodes[0], initial_position=(0.0, 0.0, 1.0))
    flat = replace(scenario, nodes=(low, *scenario.nodes[1:]))
    crossover_m = 4 * math.pi * 1.0 * 1.0 / (299_792_458 / 2.412e9)
    factor = calibrate(flat, 800).tx_power_w / calibrate(scenario, 800).tx_power_w
    assert factor == pytest.approx((800 / crossover_m) ** 2, rel=1e-6)


@pytest.mark.parametrize(("loss", "left_out"), [("", 0), ("IdealObstacleLoss", 2)])
def test_obstacles_that_a_run_would_heed_are_counted(loss: str, left_out: int) -> None:
    lengths = {"minX": 1, "maxX": 2, "minY": 1, "maxY": 2, "minZ": 0, "maxZ": 3}
    boxes = [f"*.environment.obstacle[*].{key} = {meters}m" for key, meters in lengths.items()]
    settings = ["*.environment.numObstacles = 2", f'*.radioMedium.obstacleLoss.typename = "{loss}"', *boxes]
    assert calibrate(link(*settings), 150).obstacles_left_out == left_out
