"""What NED files set by default, and what is missing."""

from collections.abc import Callable

from gradysim.omnetpp_import import Action, Translation

Translated = Callable[..., Translation]

HEAD = "[General]\nnetwork = N\nsim-time-limit = 1s\n"

NED = """
network N {
    parameters:
        int numDrones = default(5);
    submodules:
        radioMedium: Ieee80211RadioMedium;
        drones[numDrones]: AdhocHost { @display("p=1,2"); }
        base: SensorNode { @display("p=30,40"); }
}
"""


def added(translation: Translation) -> list[str]:
    return [outcome.text for outcome in translation.outcomes if outcome.action is Action.ADDED]


def missing(translation: Translation) -> list[tuple[str, str]]:
    return [
        (outcome.text.partition(" = ")[0], outcome.note)
        for outcome in translation.outcomes
        if outcome.action is Action.TO_WRITE
    ]


def test_gradys_network_has_another_medium(translated: Translated) -> None:
    translation = translated(HEAD.replace("= N\n", "= GradysNetwork\n") + "*.numUAVs = 2\n")
    assert '*.radioMedium.typename = "Ieee802154NarrowbandScalarRadioMedium"' in translation.text
    assert "*.numQuads = 2\n" in translation.text
    assert "*.numSensors = 1" in added(translation)


def test_a_medium_of_the_file_counts(translated: Translated) -> None:
    line = '*.radioMedium.typename = "UnitDiskRadioMedium"'
    translation = translated(f"{HEAD.replace('= N', '= GradysNetwork')}{line}\n")
    assert not any("radioMedium" in text for text in added(translation))


def test_all_defaults(translated: Translated) -> None:
    assert added(translated(HEAD, NED)) == [
        '*.radioMedium.typename = "Ieee80211ScalarRadioMedium"',
        "*.numDrones = 5",
        '*.drones[*].mobility.typename = "StationaryMobility"',
        '*.base.wlan[*].typename = "Ieee802154NarrowbandInterface"',
        '*.base.mobility.typename = "StationaryMobility"',
        "*.base.mobility.initialX = 30m",
        "*.base.mobility.initialY = 40m",
        '*.drones[*].protocol.class = "gradysim.showcases:CommunicationProtocolBase"',
        '*.base.protocol.class = "gradysim.showcases:CommunicationProtocolBase"',
    ]


def test_what_is_not_modelled_of_a_network(translated: Translated) -> None:
    ned = "network N { submodules: radioMedium: Ieee80211DimensionalRadioMedium; ap: AccessPoint; }"
    outcomes = translated(HEAD, ned).outcomes
    assert [each.text for each in outcomes if each.action is Action.NOT_MODELLED] == [
        '*.radioMedium.typename = "Ieee80211DimensionalRadioMedium"',
        '*.ap.typename = "AccessPoint"',
    ]


def test_random_starts(translated: Translated) -> None:
    lines = "**.initFromDisplayString = false\n*.base.mobility.initialY = 7m\n"
    lines += "".join(f"**.constraintArea{end} = 0m\n" for end in ("MinX", "MinY", "MaxX", "MaxY"))
    texts = added(translated(HEAD + lines, NED))
    assert "*.drones[*].mobility.initialX = uniform(0m, 0m)" in texts
    assert "*.base.mobility.initialX = uniform(0m, 0m)" in texts
    assert not any("base.mobility.initialY" in text for text in texts)


def test_what_paths_draw_by_default(translated: Translated) -> None:
    texts = added(translated(f'{HEAD}*.base.mobility.typename = "CircleMobility"\n', NED))
    assert "*.base.mobility.speed = 0mps" in texts
    assert "*.base.mobility.startAngle = uniform(0deg, 360deg)" in texts
    assert not any("base.mobility.initial" in text for text in texts)


def test_protocols_are_missing(translated: Translated) -> None:
    lines = '*.drones[0].protocol.typename = "OwnProtocol"\n'
    lines += '*.drones[*].app[0].typename = "PingApp"\n*.base.app[0].typename = "PingApp"\n'
    assert missing(translated(HEAD + lines, NED)) == [
        ("*.drones[0].protocol.class", "in Python, what OwnProtocol does"),
        ("*.drones[*].protocol.class", "what the others run"),
        ("*.base.protocol.class", "in Python, what PingApp does"),
    ]


def test_nodes_without_an_application_do_nothing(translated: Translated) -> None:
    lines = '*.drones[0].protocol.typename = "OwnProtocol"\n*.base.app[0].typename = "UdpSink"\n'
    texts = [text for text in added(translated(HEAD + lines, NED)) if ".protocol." in text]
    assert texts == ['*.drones[*].protocol.class = "gradysim.showcases:CommunicationProtocolBase"']


def test_a_single_node_is_named(translated: Translated) -> None:
    texts = added(translated(f'{HEAD}*.b*.app[0].typename = "UdpSink"\n', NED))
    assert '*.base.protocol.typename = "SinkProtocol"' in texts


def test_a_vector_of_a_fixed_size(translated: Translated) -> None:
    assert "*.numDrones = 7" in added(translated(HEAD, NED.replace("[numDrones]", "[7]")))
