from io import StringIO

import pytest
from rich.console import Console

from gradysim.cli.summary import (
    MAX_INTERFERERS,
    count_table,
    frames_at_nodes,
    interferer_table,
    kinds_overheard,
    messages_from_nodes,
)
from gradysim.results.result import NodeResult


def node(name, frame_outcomes, interferers=(), message_outcomes=()):
    return NodeResult(
        *(0, name, "Mobile", (0.0, 0.0, 0.0), {}),
        frame_outcomes=frame_outcomes,
        interferers=dict(interferers),
        message_outcomes=dict(message_outcomes),
    )


def lines(renderable, width=100):
    text = StringIO()
    Console(file=text, width=width).print(renderable)
    return [line.split() for line in text.getvalue().splitlines() if line.strip()]


def network(*outcomes):
    """Return counts of a network with these outcomes, in this order."""
    return {"broadcast": dict.fromkeys(outcomes, 1)}


NODES = [
    node("my_nodes[0]", {"broadcast": {"noise": 2}, "ack": {"receiver_locked": 1234}}),
    node("my_nodes[1]", {"broadcast": {"delivered": 7}}),
]


def test_a_row_for_each_kind_at_each_node_and_a_column_for_each_outcome_in_their_order():
    assert lines(
        frames_at_nodes(NODES, network("delivered", "noise", "interference", "receiver_locked"))
    ) == [
        ["receiver"],
        ["at", "delivered", "noise", "locked"],
        ["─" * len("my_nodes[0] broadcast   delivered   noise   receiver")],
        ["my_nodes[0]", "broadcast", "0", "2", "0"],
        ["my_nodes[0]", "ack", "0", "0", "1,234"],
        ["my_nodes[1]", "broadcast", "7", "0", "0"],
        ["sum", "7", "2", "1,234"],
    ]


def test_in_a_narrow_console_the_columns_follow_each_other():
    shown = lines(frames_at_nodes(NODES, network("delivered", "noise")), width=35)
    assert ["my_nodes[1]", "broadcast", "7"] in shown
    assert ["my_nodes[0]", "broadcast", "2"] in shown


def test_nodes_that_nothing_reached_are_told():
    assert lines(frames_at_nodes([node("uavs[0]", {})], network("delivered"))) == [
        ["no", "frame", "was", "strong", "enough", "to", "be", "received", "there"]
    ]


@pytest.mark.parametrize(
    ("kinds", "text"),
    [
        (["broadcast"], ""),
        (["broadcast", "unicast"], "unicast"),
        (["unicast", "ack"], "unicast and ack"),
        (["broadcast", "unicast", "ack", "rts"], "unicast, ack and rts"),
    ],
)
def test_kinds_of_frames_that_may_be_for_others_are_named(kinds, text):
    nodes = [node("a", {}), *(node(f"n[{kind}]", {kind: {"delivered": 1}}) for kind in kinds)]
    assert kinds_overheard(nodes) == text


def test_interferers_by_their_copies():
    outcomes = {"broadcast": {"interference": 3}, "unicast": {"interference": 2, "delivered": 9}}
    table = interferer_table([node("a", {}), node("b", outcomes, {"c": 1, "d": 4, "e": 1})])
    assert lines(table)[2:] == [["b", "5", "d", "4,", "c", "1,", "e", "1"]]


def test_many_interferers_are_cut_short():
    many = {f"n[{index}]": 1 for index in range(MAX_INTERFERERS + 2)}
    *_, row = lines(interferer_table([node("a", {"broadcast": {"interference": 12}}, many)]), width=300)
    assert row[-6:] == ["n[9]", "1,", "…", "and", "2", "more"]


def test_a_row_for_each_kind_of_message_from_each_node():
    sender = {"wlan[0]": {"unicast": {"acknowledged": 1234, "retry_limit": 1}, "broadcast": {"sent": 5}}}
    silent = {"wlan[0]": {}}
    nodes = [node("a", {}, message_outcomes=sender), node("b", {}, message_outcomes=silent)]
    assert lines(messages_from_nodes(nodes, network("sent", "acknowledged", "retry_limit", "queued"))) == [
        ["retry"],
        ["from", "sent", "acknowledged", "limit"],
        ["─" * len("a broadcast   sent   acknowledged   retry")],
        ["a", "unicast", "0", "1,234", "1"],
        ["a", "broadcast", "5", "0", "0"],
        ["sum", "5", "1,234", "1"],
    ]


def test_the_interface_is_named_where_there_are_several():
    two = {"wlan[0]": {}, "wlan[1]": {"broadcast": {"sent": 3}}}
    table = messages_from_nodes([node("relay", {}, message_outcomes=two)], network("sent"))
    assert ["relay.wlan[1]", "broadcast", "3"] in lines(table)


def test_nodes_that_sent_nothing_are_told():
    assert lines(messages_from_nodes([node("a", {}, message_outcomes={"wlan[0]": {}})], network("sent"))) == [
        ["no", "protocol", "sent", "a", "message", "there"]
    ]


COLUMNS = {
    kind: {"below sensitivity": 1_234_567, "receiver transmitting": number}
    for number, kind in enumerate(
        ["broadcast", "unicast", "unicast overheard", "ack", "ack overheard", "rts"]
    )
}


def printed(columns, width):
    text = StringIO()
    Console(file=text, width=width).print(count_table("outcome", columns))
    return text.getvalue()


def test_rows_columns_and_sums():
    text = printed({"one": {"a": 1, "b": 2000}, "two words": {"b": 3}}, width=80)
    assert [line.split() for line in text.splitlines() if line.strip() and "─" not in line] == [
        ["two"],
        ["outcome", "one", "words"],
        ["a", "1", "0"],
        ["b", "2,000", "3"],
        ["sum", "2,001", "3"],
    ]


@pytest.mark.parametrize("width", [50, 80, 200])
def test_no_digit_is_lost_in_a_narrow_console(width):
    text = printed(COLUMNS, width)
    assert text.count("1,234,567") == len(COLUMNS) + 1  # the sum of the first column is the same
    assert "…" not in text


def test_there_is_one_table_where_there_is_room():
    lines = [line.split() for line in printed(COLUMNS, 200).splitlines()]
    assert ["receiver", "transmitting", "0", "1", "2", "3", "4", "5"] in lines
