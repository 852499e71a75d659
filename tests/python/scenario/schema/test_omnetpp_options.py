"""Each option of OMNeT++ 6.1 (`opp_run -h config`, `%` as 0) is supported, ignored or rejected."""

import pytest

from gradysim.scenario import load_scenarios
from gradysim.scenario.errors import ConfigError

IGNORED = """
    allow-object-stealing-on-deletion **.bin-recording check-signals cmdenv-autoflush
    cmdenv-config-name cmdenv-event-banner-details cmdenv-event-banners cmdenv-express-mode
    cmdenv-extra-stack cmdenv-fake-gui cmdenv-fake-gui-after-event-probability
    cmdenv-fake-gui-before-event-probability cmdenv-fake-gui-on-hold-numsteps
    cmdenv-fake-gui-on-hold-probability cmdenv-fake-gui-on-simtime-numsteps
    cmdenv-fake-gui-on-simtime-probability cmdenv-fake-gui-seed cmdenv-interactive
    **.cmdenv-log-level cmdenv-log-prefix cmdenv-output-file cmdenv-performance-display
    cmdenv-redirect-output cmdenv-runs-to-execute cmdenv-status-frequency cmdenv-stop-batch-on-error
    config-recording configuration-class debug-on-errors debug-statistics-recording
    debugger-attach-command debugger-attach-on-error debugger-attach-on-startup
    debugger-attach-wait-time **.display-name **.display-string eventlog-file
    eventlog-index-frequency eventlog-max-size eventlog-message-detail-pattern
    eventlog-min-truncated-size eventlog-options eventlog-recording-intervals
    eventlog-snapshot-frequency eventlogmanager-class fingerprint fingerprint-events
    fingerprint-ingredients fingerprint-modules fingerprint-results fingerprintcalculator-class
    fname-append-host futureeventset-class image-path load-libs max-module-nesting
    **.module-eventlog-recording ned-package-exclusions ned-path num-rngs
    output-scalar-db-commit-freq output-scalar-file output-scalar-file-append
    output-scalar-precision output-vector-db-indexing output-vector-file output-vector-file-append
    output-vector-precision output-vectors-memory-limit outputscalarmanager-class
    outputvectormanager-class parallel-simulation **.param-record-as-scalar **.param-recording
    parameter-mutability-check parsim-communications-class parsim-num-partitions
    parsim-synchronization-class **.partition-id print-instantiated-ned-types print-undisposed
    print-unused-parameters record-eventlog result-dir **.result-recording-modes
    resultdir-subdivision **.rng-0 rng-class runnumber-width **.scalar-recording
    sectionbasedconfig-configreader-class simtime-resolution simtime-scale snapshot-file
    snapshotmanager-class **.statistic-recording total-stack user-interface **.vector-buffer
    **.vector-record-empty **.vector-record-eventnumbers **.vector-recording
    **.vector-recording-intervals warnings
    qtenv-stop-event-cancel
"""

REFUSED = """
    cpu-time-limit real-time-limit realtimescheduler-scaling scheduler-class seed-0-lcg32 seed-0-mt
    seed-0-mt-p0 warmup-period
"""

FILE = """[General]
sim-time-limit = 1s
*.numNodes = 1
*.nodes[*].protocol.typename = "BeaconProtocol"
*.nodes[*].mobility.typename = "StationaryMobility"
"""


@pytest.fixture
def load(tmp_path):
    def with_line(line):
        file = tmp_path / "shared.ini"
        file.write_text(f"{FILE}{line}\n")
        return load_scenarios(file)

    return with_line


@pytest.mark.parametrize("option", IGNORED.split())
def test_what_says_how_omnetpp_runs_and_records_is_ignored(load, option):
    (scenario,) = load(f"{option} = whatever 'it' is")
    assert scenario.settings_hash == load("")[0].settings_hash


@pytest.mark.parametrize("option", REFUSED.split())
def test_what_would_make_another_run_is_refused(load, option):
    with pytest.raises(ConfigError) as caught:
        load(f"{option} = 1")
    assert (caught.value.line, caught.value.key) == (6, option)
