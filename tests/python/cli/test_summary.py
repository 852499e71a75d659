import math
from dataclasses import replace
from io import StringIO

import pytest
from rich.console import Console

from gradysim.cli.summary import MAX_CELL_LENGTH, MAX_ROWS, MAX_VALUE_LENGTH, print_summary, run_line, short
from gradysim.results.delays import constant_delays
from gradysim.results.result import NodeResult, RunResult


def result(**changes):
    node = NodeResult(0, "uavs[0]", "Mobile", (1.0, 2.25, -3.0), {"data": 5, "color": "[red]"})
    fields = {
        "config": "ZigZag5",
        "run": 2,
        "seed": 7,
        "mode": "integrated",
        "sim_time_s": 7200.0,
        "wall_s": 2.0,
        "cpu_s": 1.9,
        "setup_s": 0.25,
        "events": 123456,
        "interrupted": False,
        "fingerprint": "0123456789abcdef",
        "outcomes": {
            "frames": {
                "broadcast": {"delivered": 1500, "below_sensitivity": 2, "interference": 0},
                "ack": {"delivered": 3},
            },
            "messages": {"broadcast": {"sent": 0}},
        },
        "nodes": (node,),
    }
    return RunResult(**{**fields, **changes})


def printed(width=100, details=True, **changes):
    text = StringIO()
    print_summary(result(**changes), Console(file=text, width=width), details=details)
    return text.getvalue()


def short_rows(width=80, **changes):
    """Return the rows of the summary, as lists of words; \xa0 does not separate words here."""
    text = printed(width, details=False, **changes)
    assert all(len(line) <= width for line in text.splitlines())
    return [[word for word in line.split(" ") if word] for line in text.splitlines()]


@pytest.mark.parametrize(
    "what",
    [
        "ZigZag5 run 2",
        "seed 7, integrated mode",
        "7,200 s",
        "2.000 s (3,600 x real time)",
        "processor time  1.900 s",
        "setup time      0.250 s",
        "123,456",
        "result hash 8e78a864d2338eaf",
        "uavs[0]",
        "Mobile",
        "1.0, 2.2, -3.0",
        "data = 5",
        "color = [red]",
        "Outcomes of frames, a reception for each radio",
    ],
)
def test_what_is_in_it(what):
    assert what in printed()


def test_the_summary_has_a_row_for_each_node_and_a_column_for_each_variable():
    rows = short_rows()
    assert ["node", "in\xa0m", "data", "color"] in rows
    assert ["uavs[0]", "1.0,", "2.2,", "-3.0", "5", "[red]"] in rows
    assert [
        "7,200",
        "s",
        "simulated",
        "in",
        "2.000",
        "s",
        "(3,600",
        "x",
        "real",
        "time),",
        "123,456",
        "events",
    ] in rows


def named(values, group="uavs"):
    return tuple(
        NodeResult(index, f"{group}[{index}]", "Mobile", (0.0, 0.0, 0.0), variables)
        for index, variables in enumerate(values)
    )


def test_many_nodes_are_a_row_for_each_group():
    uavs = named([{"data": index, "sent": 30, "state": "ab"[index % 2]} for index in range(MAX_ROWS)])
    station = NodeResult(MAX_ROWS, "groundStation", "Station", (0.0, 0.0, 0.0), {"data": 7})
    rows = short_rows(nodes=(*uavs, station))
    assert ["group", "nodes", "data", "sent", "state"] in rows
    assert ["uavs", "12", "5.5", "(0..11)", "30", "2", "values"] in rows
    assert ["groundStation", "1", "7"] in rows
    assert not any("uavs[0]" in row for row in rows)


def test_positions_give_way_to_variables():
    variables = {f"variable_{index}": index for index in range(5)}
    wide, narrow = short_rows(120, nodes=named([variables])), short_rows(80, nodes=named([variables]))
    assert any("0.0," in row for row in wide)
    assert not any("0.0," in row for row in narrow)
    assert ["uavs[0]", "0", "1", "2", "3", "4"] in narrow


def test_variables_that_do_not_fit_follow_below():
    variables = {f"a_long_name_of_a_variable_{index}": index for index in range(5)}
    rows = short_rows(nodes=named([variables]))
    assert [row for row in rows if row[:1] == ["uavs[0]"]] == [
        ["uavs[0]", "0", "1"],
        ["uavs[0]", "2", "3"],
        ["uavs[0]", "4"],
    ]


def test_a_long_value_is_cut_shorter():
    rows = short_rows(nodes=named([{"list": "x" * 1000}]))
    assert any("x" * (MAX_CELL_LENGTH - 1) + "…" in row for row in rows)


def test_kinds_are_rows_with_the_outcomes_that_there_were():
    delays = {"unicast": constant_delays({0.001: 93, 0.002: 4, 0.003: 3})}
    outcomes = {
        "frames": {
            "broadcast": {"delivered": 0},
            "unicast": {"delivered": 5, "noise": 0, "interference": 2},
            "unicast overheard": {"delivered": 9},
        },
        "messages": {"unicast": {"acknowledged": 1234, "queued": 0}},
    }
    rows = short_rows(outcomes=outcomes, message_delays=delays)
    assert ["receptions", "delivered", "interference"] in rows
    assert ["unicast", "5", "2"] in rows
    assert ["unicast", "1,234", "1.1", "ms", "2", "ms"] in rows
    assert not any("overheard" in row or "broadcast" in row for row in rows)


def test_a_summary_fits_a_screen_of_40_lines():
    kinds = ["broadcast", "unicast", "ack", "rts", "cts"]
    frames = {kind: dict.fromkeys(["delivered", "noise", "interference"], 1) for kind in kinds}
    messages = {kind: {"sent": 1} for kind in kinds[:2]}
    variables = {"data": 5, "sent": 6}
    text = printed(
        80, False, nodes=named([variables] * MAX_ROWS), outcomes={"frames": frames, "messages": messages}
    )
    assert len(text.splitlines()) <= 40


def test_a_run_of_several_is_a_line():
    shown = run_line(result(), "run 2  $x=1 #0", 80)
    assert shown == "run 2  $x=1 #0  data 5  broadcast delivered 99.87 %  2.000 s"
    assert (
        run_line(result(), "run 2  $x=1 #0", 30) == "run 2  $x=1 #0  data 5  2.000 s"[:30].rsplit("  ", 1)[0]
    )


def test_the_line_has_the_means_of_groups():
    nodes = (
        *named([{"data": 1}, {"data": 2, "flag": True}, {"data": math.nan}]),
        *named([{"data": 7}], "sensors"),
    )
    assert (
        run_line(result(nodes=nodes, outcomes={}), "run 2", 80)
        == "run 2  uavs data 1.5  sensors data 7  2.000 s"
    )


def test_the_line_of_an_interrupted_run_says_so():
    assert "12.5 s" in run_line(result(interrupted=True, sim_time_s=12.5), "run 2", 80)


def test_nodes_are_a_table_with_a_row_for_each():
    rows = [line.split() for line in printed().splitlines()]
    heading = rows.index(["id", "name", "protocol", "position", "in", "m", "tracked", "variables"])
    place = ["1.0,", "2.2,", "-3.0"]
    assert rows[heading + 2] == ["0", "uavs[0]", "Mobile", *place, "data", "=", "5"]


def test_delays_of_messages():
    delays = {"unicast": constant_delays({0.0003: 1999, 1.5: 1})}
    lines = printed(message_delays=delays).splitlines()
    row = next(line for line in lines if line.startswith("unicast"))
    assert row.split() == ["unicast", "2,000", *["1.05", "ms", "0.3", "ms", "0.3", "ms", "1,500", "ms"]]


def test_the_delay_that_95_percent_do_not_exceed_is_told():
    delays = {"unicast": constant_delays({0.001: 93, 0.002: 4, 0.003: 3})}
    row = next(line for line in printed(message_delays=delays).splitlines() if line.startswith("unicast"))
    assert row.split()[-4:] == ["2", "ms", "3", "ms"]


def test_a_delay_of_many_seconds_is_written_out():
    lines = printed(message_delays={"unicast": constant_delays({12.3456: 1})}).splitlines()
    assert next(line for line in lines if line.startswith("unicast")).endswith("12,346 ms")


def test_no_table_of_delays_without_messages():
    assert "Delays" not in printed()


def test_values_of_iteration_variables_are_in_the_heading():
    shown = printed(iterations={"jitter": "10ms", "0": "5"}, mode="prototype")
    heading = "ZigZag5 run 2  $jitter=10ms, $0=5, seed 7, prototype mode, result hash "
    assert shown.splitlines()[0][:-16] == heading


def test_outcomes_are_a_table_with_a_column_per_kind():
    lines = [line.split() for line in printed().splitlines()]
    assert ["outcome", "broadcast", "ack"] in lines
    assert ["delivered", "1,500", "3"] in lines
    assert ["below", "sensitivity", "2", "0"] in lines
    assert ["sum", "1,502", "3"] in lines


def test_a_table_of_nothing_is_left_out():
    assert "Outcomes" not in printed(outcomes={"frames": {"broadcast": {"delivered": 0}}})


def test_what_belongs_to_options_is_shown_where_there_was_any():
    kinds = {
        "unicast": {"delivered": 1, "noise": 0, "captured": 2, "header_error": 0},
        "ack": {"delivered": 0, "noise": 0, "captured": 0, "header_error": 0},
        "rts": {"delivered": 0, "noise": 0, "captured": 0, "header_error": 0},
        "cts": {"delivered": 3, "noise": 0, "captured": 0, "header_error": 0},
    }
    lines = [line.split() for line in printed(outcomes={"frames": kinds}).splitlines()]
    assert ["outcome", "unicast", "ack", "cts"] in lines
    assert ["noise", "0", "0", "0"] in lines
    assert ["captured", "2", "0", "0"] in lines
    assert not any("header" in line for line in lines)


def test_an_interrupted_run_is_marked_on_a_line_of_its_own():
    (line,) = (
        line for line in printed(interrupted=True, sim_time_s=12.5).splitlines() if "interrupted" in line
    )
    assert "12.5 s" in line


def test_the_time_of_an_interruption_is_the_simulated_time():
    text = printed(interrupted=True, sim_time_s=2345678.900000000058)
    assert text.count("2,345,678.9 s") == 2


def test_a_whole_run_is_not():
    assert "interrupted" not in printed()


def test_a_run_shorter_than_a_second_has_a_speed():
    assert "0.500 s (14,400 x real time)" in printed(wall_s=0.5)


def test_a_run_that_took_no_time_has_no_speed():
    assert " x " not in printed(wall_s=0.0)


def test_a_long_value_is_cut():
    assert short("x" * 1000) == "x" * (MAX_VALUE_LENGTH - 1) + "…"


def test_a_value_that_just_fits_is_not_cut():
    assert short("x" * MAX_VALUE_LENGTH) == "x" * MAX_VALUE_LENGTH


def test_what_is_no_number_is_shown_as_that():
    assert short(math.nan) == "nan"


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (59.90000000000058, "59.9"),
        (60.00000000000058, "60.0"),
        ([(59.90000000000058, 1e-17)], "[[59.9, 1e-17]]"),
        ({"at": 0.1 + 0.2}, "{'at': 0.3}"),
        (True, "True"),
        (12345678901234567, "12345678901234567"),
    ],
)
def test_sums_of_steps_are_shown_without_the_rests_of_rounding(value, shown):
    assert short(value) == shown


def test_a_whole_number_of_any_size_is_shown():
    assert short(10**198) == "1" + "0" * 198
    assert short(10**400).endswith("…")


def test_a_lone_surrogate_is_escaped():
    node = NodeResult(0, "uavs[0]", "Mobile", (0.0, 0.0, 0.0), {"na\udc80me": "va\ud800lue"})
    text = printed(nodes=(node,))
    assert text.encode().decode() == text
    assert r"na\udc80me = va\ud800lue" in text


def nodes(count):
    return tuple(NodeResult(i, f"uavs[{i}]", "Mobile", (-0.04, -0.06, 0.0), {}) for i in range(count))


@pytest.mark.parametrize(("count", "shown"), [(50, 50), (51, 20)])
def test_many_nodes_are_cut_short(count, shown):
    text = printed(nodes=nodes(count))
    assert text.count("uavs[") == shown
    assert (f"… and {count - shown} " in text) is (shown < count)


def told_nodes(count):
    """Return nodes of a run with outcomes of frames."""
    outcomes = {"broadcast": {"delivered": 2, "interference": 1}}
    told = {
        "frame_outcomes": outcomes,
        "interferers": {"uavs[0]": 1},
        "message_outcomes": {"wlan[0]": {"unicast": {"sent": 4}}},
    }
    return tuple(replace(node, **told) for node in nodes(count))


def test_outcomes_at_nodes_are_there_if_the_run_was_asked_for_them():
    lines = [line.split() for line in printed(nodes=(*told_nodes(1), *nodes(1))).splitlines()]
    assert ["uavs[0]", "broadcast", "2", "1"] in lines
    assert ["uavs[0]", "1", "uavs[0]", "1"] in lines
    assert ["uavs[0]", "unicast", "4"] in lines
    assert "frames at" not in printed()


@pytest.mark.parametrize(("kind", "told"), [("unicast", True), ("broadcast", False)])
def test_what_was_overheard_at_nodes_is_told_where_there_may_be_any(kind, told):
    at_node = replace(*nodes(1), frame_outcomes={kind: {"delivered": 1}}, message_outcomes={})
    assert ("overheard" in printed(nodes=(at_node,))) is told


@pytest.mark.parametrize(("count", "shown"), [(50, 50), (51, 20)])
def test_outcomes_at_many_nodes_are_cut_short(count, shown):
    _, _, text = printed(nodes=told_nodes(count)).partition("Outcomes of frames at nodes")
    assert (text.count(" broadcast "), text.count(" unicast ")) == (shown, shown)
    assert (f"… and {count - shown} " in text) is (shown < count)


def test_what_rounds_to_zero_has_no_sign():
    assert " 0.0, -0.1, 0.0 " in printed(nodes=nodes(1))
