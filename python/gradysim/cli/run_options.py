"""The options of `gradysim run` that no other command has."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from gradysim.cli.arguments import Mode, WholeNumber


def _flag(help_text: str, name: str | None = None) -> Parameter:
    """Describe an option without a value."""
    return Parameter(name=name, negative="", help=help_text)


def _of_nodes(help_text: str) -> Parameter:
    """Describe an option that takes the names of nodes."""
    return Parameter(
        negative="",
        consume_multiple=(1, None),
        show_default=False,
        help=f"NODE...: {help_text} A node (uavs[0]), a group (uavs), or all.",
    )


RunsOption = Annotated[
    str | None,
    Parameter(alias="-r", help="Run numbers such as 0..3,5; all runs of the configuration by default."),
]

ModeOption = Annotated[
    Mode,
    Parameter(
        help="The 802.11 network of the compiled engine, or the plain simulator in Python. Their messages"
        " reach 786 m and 60 m by default: `gradysim keys range`."
    ),
]

SeedOption = Annotated[
    WholeNumber | None,
    Parameter(help="Seed of run 0, to which run N adds N; by default the file's seed-set."),
]

ResultDirOption = Annotated[
    Path | None, Parameter(help="Write each run's JSON object to DIR/CONFIG-#RUN.MODE.json.")
]

ResumeOption = Annotated[
    bool,
    _flag(
        "Leave out runs whose file in --result-dir is complete and of the same settings, seed and"
        " files (protocols, obstacles), with what --scalars, --vectors, --pcap and --fates-at ask for."
    ),
]

JobsOption = Annotated[
    WholeNumber, Parameter(alias="-j", help="How many runs at once, each in a process of its own.")
]

ScalarsOption = Annotated[
    bool,
    _flag(
        "Write the numbers of each run to DIR/CONFIG-#RUN.MODE.sca for OMNeT++'s analysis tools,"
        " DIR as in --result-dir (default: results)."
    ),
]

VectorsOption = Annotated[
    tuple[str, ...],
    _of_nodes(
        "write what tracked variables and positions of these nodes were over time to"
        " DIR/CONFIG-#RUN.MODE.vec, DIR as above."
    ),
]

PcapOption = Annotated[
    tuple[str, ...],
    _of_nodes(
        "write what the radios of these nodes send and receive to DIR/CONFIG-#RUN-NODE.pcap"
        " (that of its wlan[1]: …-wlan1.pcap), DIR as in --result-dir (default: results)."
    ),
]

FatesAtOption = Annotated[
    tuple[str, ...],
    _of_nodes(
        "tell what became of the frames that reached these nodes, who interfered,"
        " and what became of the messages that they sent."
    ),
]

JsonOption = Annotated[bool, _flag("Print one JSON object per run, one per line, no more.", "--json")]

QuietOption = Annotated[bool, _flag("No progress bar and no summaries: warnings and failures only.")]
