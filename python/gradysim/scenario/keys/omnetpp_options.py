"""Options that only OMNeT++ has, in files that are shared with it.

Those that say how it runs, shows and records are ignored. Those that would make another run are refused.
"""

from types import MappingProxyType

IGNORED_OPTIONS = (
    "allow-object-stealing-on-deletion",
    "check-signals",
    "cmdenv-*",
    "config-recording",
    "configuration-class",
    "debug-on-errors",
    "debug-statistics-recording",
    "debugger-attach-*",
    "eventlog-*",
    "eventlogmanager-class",
    "fingerprint*",
    "fname-append-host",
    "futureeventset-class",
    "image-path",
    "load-libs",
    "max-module-nesting",
    "ned-*",
    "num-rngs",
    "output-scalar-*",
    "output-vector*",
    "outputscalarmanager-class",
    "outputvectormanager-class",
    "parallel-simulation",
    "parameter-mutability-check",
    "parsim-*",
    "print-*",
    "qtenv-*",
    "record-eventlog",
    "result-dir",
    "resultdir-subdivision",
    "rng-class",
    "runnumber-width",
    "sectionbasedconfig-configreader-class",
    "simtime-resolution",
    "simtime-scale",
    "snapshot-file",
    "snapshotmanager-class",
    "total-stack",
    "user-interface",
    "warnings",
)
"""Of a run, with `*` for any letters."""

IGNORED_BEGINNINGS = ("cmdenv-", "qtenv-", "rng-", "vector-record", "vector-buffer")
"""Of the last names of keys: options that are given per module, such as `**.cmdenv-log-level`."""

IGNORED_ENDS = (
    *(f"{kind}-recording" for kind in ("scalar", "statistic", "bin", "param", "module-eventlog")),
    "result-recording-modes",
    "param-record-as-scalar",
    "display-name",
    "display-string",
    "partition-id",
)
"""Last names of keys: what OMNeT++ records of a module, shows of it, and where it runs it."""

IGNORED_MODULES = ("visualizer",)
"""Names below the network whose parameters are OMNeT++'s alone."""

REFUSED_OPTIONS = MappingProxyType(
    {
        "warmup-period": "results are of whole runs; expected a protocol that begins to count later",
        "cpu-time-limit": "a run ends in simulated time; expected `sim-time-limit`",
        "real-time-limit": "a run ends in simulated time; expected `sim-time-limit`",
        "scheduler-class": "expected `real_time` in a script, for runs that go by the clock",
        "realtimescheduler-scaling": "expected `real_time` in a script, for runs that go by the clock",
        "seed-*": "a run has one seed for all its streams; expected `seed-set`",
    }
)
"""{option, with `*` for any letters: what to do without it}."""
