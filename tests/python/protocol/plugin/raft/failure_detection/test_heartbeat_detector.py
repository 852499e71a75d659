import pytest

from gradysim.protocol.plugin.raft import FailureConfig
from gradysim.protocol.plugin.raft.failure_detection import HeartbeatDetector


class Watch:
    """A detector of nodes 1 and 2 with heartbeats every 50 ms."""

    def __init__(self):
        self.time_s = 0.0
        self.news = []
        config = FailureConfig()
        config.set_heartbeat_interval_reference(50)
        self.detector = HeartbeatDetector(
            config,
            {1, 2},
            lambda node_id: self.news.append(("failed", node_id)),
            lambda node_id: self.news.append(("recovered", node_id)),
            lambda: self.time_s,
        )

    def beat(self, count, *answering):
        for _ in range(count):
            self.time_s += 0.05
            for node_id in (1, 2):
                self.detector.record_heartbeat_sent(node_id)
            self.detector.on_heartbeat_sent()
            for node_id in answering:
                self.detector.record_heartbeat_response(node_id, True, 3.0)


@pytest.fixture
def watch():
    return Watch()


def test_who_answers_stays_active(watch):
    watch.beat(40, 1, 2)
    assert watch.detector.get_active_nodes() == {1, 2}


def test_who_falls_silent_is_failed(watch):
    watch.beat(4, 1, 2)
    watch.beat(12, 1)
    assert (watch.detector.get_failed_nodes(), watch.news) == ({2}, [("failed", 2)])


def test_who_never_answered_is_failed(watch):
    watch.beat(14, 1)
    assert watch.detector.is_node_failed(2)


def test_a_few_lost_answers_are_no_failure(watch):
    watch.beat(4, 1, 2)
    watch.beat(5, 1)
    watch.beat(1, 1, 2)
    watch.beat(5, 1)
    assert watch.news == []


def test_who_answers_again_recovers(watch):
    watch.beat(14, 1)
    watch.beat(1, 1, 2)
    before = watch.detector.is_node_failed(2)
    watch.beat(1, 1, 2)
    assert (before, watch.news) == (True, [("failed", 2), ("recovered", 2)])


def test_when_it_failed_and_recovered_is_told(watch):
    watch.beat(14, 1)
    watch.beat(2, 1, 2)
    watch.time_s += 1.0
    history = watch.detector.get_detection_metrics()["node_histories"][2]
    assert history["last_recovery"] == pytest.approx(0.8)
    assert history["time_since_last_recovery"] == pytest.approx(1000.0)


def test_failures_can_be_recorded_without_a_clock():
    config = FailureConfig()
    config.set_absolute_timeout(100)
    detector = HeartbeatDetector(config, {1})
    for _ in range(3):
        detector.record_heartbeat_response(1, False)
    detector.on_heartbeat_sent()
    detector.on_heartbeat_sent()
    assert detector.get_failed_nodes() == {1}


def test_nobody_need_be_told():
    config = FailureConfig()
    config.set_heartbeat_interval_reference(50)
    detector = HeartbeatDetector(config, {1})
    detector.mark_failed(1)
    for _ in range(2):
        detector.record_heartbeat_response(1, True)
    assert detector.get_active_nodes() == {1}


def test_strangers_are_ignored(watch):
    watch.detector.record_heartbeat_response(9, True)
    watch.detector.remove_node(9)
    watch.detector.reset_node(9)
    assert (watch.detector.is_node_failed(9), watch.detector.get_node_statistics(9)) == (False, {})


def test_nodes_come_and_go(watch):
    watch.detector.add_node(3)
    watch.detector.remove_node(1)
    assert watch.detector.get_active_nodes() == {2, 3}


def test_who_was_not_found_is_failed_until_it_answers(watch):
    watch.detector.mark_failed(2)
    watch.beat(2, 1, 2)
    assert (watch.detector.get_failed_nodes(), watch.news) == (set(), [("recovered", 2)])


def test_the_summary_counts(watch):
    watch.beat(14, 1)
    summary = watch.detector.get_detection_summary()
    assert (summary["total_nodes"], summary["active_nodes"], summary["failed_nodes"]) == (2, 1, 1)
    assert summary["performance"]["total_heartbeats_sent"] == 28
    assert summary["performance"]["average_response_time_ms"] == 3.0
    assert summary["detection_stats"] == {"total_failures_detected": 1, "total_recoveries_detected": 0}
    assert summary["node_details"][2]["status"] == "FAILED"
    assert summary["node_details"][1]["recent_response_times"] == [3.0] * 5


def test_the_latest_response_times_are_remembered(watch):
    for response_time_ms in range(12):
        watch.detector.record_heartbeat_response(1, True, response_time_ms)
    metrics = watch.detector.get_detection_metrics()
    assert metrics["performance"]["average_response_time_ms"] == 6.5  # of the last ten
    assert metrics["node_histories"][1]["recent_response_times"] == [7, 8, 9, 10, 11]


def test_the_metrics_count(watch):
    watch.beat(14, 1)
    metrics = watch.detector.get_detection_metrics()
    assert metrics["performance"]["total_successful_responses"] == 14
    assert metrics["performance"]["success_rate_percent"] == 100.0
    assert metrics["detection"]["heartbeat_counter"] == 14
    assert metrics["configuration"]["timeout_ms"] == 200
    assert metrics["node_histories"][2]["last_failure"] == pytest.approx(0.6)
    assert "time_since_last_failure" not in metrics["node_histories"][1]


def test_the_rates_are_shares_of_the_answers(watch):
    for success in (True, False, True, True):
        watch.detector.record_heartbeat_response(1, success)
    performance = watch.detector.get_detection_metrics()["performance"]
    assert (performance["total_responses_received"], performance["total_failed_responses"]) == (4, 1)
    assert (performance["success_rate_percent"], performance["failure_rate_percent"]) == (75.0, 25.0)


def test_before_the_first_heartbeat_there_is_nothing_to_tell(watch):
    performance = watch.detector.get_detection_metrics()["performance"]
    assert set(performance.values()) == {0}
