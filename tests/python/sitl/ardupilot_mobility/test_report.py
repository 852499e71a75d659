import logging

from gradysim.sitl.ardupilot_mobility.report import NodeReport, write_report


def test_a_row_for_each_node(tmp_path):
    nodes = {0: NodeReport(10, 2, 99.0, 90.0), 4: NodeReport(5, 0)}
    write_report(tmp_path / "report.csv", nodes)
    assert (tmp_path / "report.csv").read_text().splitlines() == [
        "node_id,telemetry_requests,telemetry_drops,battery_wasted",
        "0,10,2,9.0",
        "4,5,0,",
    ]


def test_the_log_tells_the_same_and_the_clocks(tmp_path, caplog):
    caplog.set_level(logging.INFO)
    write_report(tmp_path / "report.csv", {3: NodeReport(10, 2, 99.0, 90.0, -0.25)})
    (line,) = [line for line in caplog.text.splitlines() if line.startswith("3 ")]
    assert line.split() == ["3", "10", "2", "9", "-0.25"]


def test_a_folder_that_takes_no_file_is_a_warning(tmp_path, caplog):
    caplog.set_level(logging.INFO)
    write_report(tmp_path / "nowhere" / "report.csv", {3: NodeReport(10, 2, 99.0, 90.0, -0.25)})
    warning, table = caplog.messages
    assert "[Errno 2]" in warning
    assert str(tmp_path) not in table
