"""Runs the networks of configs/reference/ns3_networks.ini in ns-3 and prints what each station received.

    python tests/verification/ns3/record.py >tests/verification/reference/ns3_networks.csv

Needs ns-3: Debian's (`make need-ns3`), or `--prefix DIR`, the directory `ns3` of the wheel on PyPI. `tests`
must be on PYTHONPATH. The reference was made with 3.44 from PyPI.
"""

import argparse
import csv
import subprocess
import sys
from math import log10
from pathlib import Path
from tempfile import TemporaryDirectory

from gradysim.scenario import Scenario
from gradysim.scenario.parse.ini import read_ini
from gradysim.scenario.parse.sections import config_names
from gradysim.scenario.schema.values import Setting
from verification.reference_run import FOLDER, load_reference

SOURCE = Path(__file__).with_name("stations.cpp")
MODULES = ("core", "network", "mobility", "propagation", "wifi", "spectrum", "energy")
NAME = "ns3_networks"
COLUMNS = ("version", "phy", "config", "seed", "station", "received", "data", "rts", "given_up")


def compiled(prefix: Path | None, version: str, folder: Path) -> Path:
    """Compile the program for Debian's ns-3, or for the wheel of that version in `prefix`."""
    program = folder / f"stations_{version}"
    command = ["g++", "-O2", str(SOURCE), "-o", str(program)]
    if prefix is None:
        command += ["-std=c++17", *(f"-lns3-{module}" for module in MODULES)]
    else:
        libraries = prefix / "lib64"
        command += ["-std=c++20", f"-I{prefix / 'include'}", f"-L{libraries}", f"-Wl,-rpath,{libraries}"]
        command += [f"-lns{version}-{module}" for module in MODULES]
    subprocess.run(command, check=True)
    return program


def mode_name(standard: str, mbps: float) -> str:
    """Return ns-3's name of a bit rate."""
    rate = f"{mbps:g}".replace(".", "_")
    if mbps in (1, 2, 5.5, 11):
        return f"DsssRate{rate}Mbps"
    return f"{'Erp' if standard == 'g' else ''}OfdmRate{rate}Mbps"


def arguments(scenario: Scenario, phy: str, seed: int) -> list[str]:
    """Return the options of the program for a network."""
    wlan = scenario.nodes[-1].wlan[0]
    standard = str(wlan.mac["op_mode"].value)[0]
    options = {
        "phy": phy,
        "standard": standard,
        "rate": mode_name(standard, number(wlan.mac["bitrate_bps"]) / 1e6),
        "control": mode_name(standard, number(wlan.mac["control_bitrate_bps"]) / 1e6),
        "power": f"{10 * log10(1000 * number(wlan.radio['tx_power_w'])):.6g}",
        "until": f"{scenario.sim_time_limit_s:g}",
        "seed": str(seed),
    }
    if "rts_threshold_bytes" in wlan.mac:
        options["rts"] = f"{number(wlan.mac['rts_threshold_bytes']):g}"
    options["ns3::WifiMacQueue::MaxDelay"] = "1000s"  # the engine has no lifetime of messages
    return [f"--{name}={value}" for name, value in options.items()]


def number(setting: Setting) -> float:
    """Return the value of a setting that is a number."""
    assert isinstance(setting.value, int | float)
    return float(setting.value)


def stations(scenario: Scenario) -> str:
    """Return the lines of the program: position and destination of each station."""
    lines = []
    for node in scenario.nodes:
        x, y, _ = node.initial_position
        values = node.protocol_parameters
        is_source = node.protocol.__name__ != "Sink"
        destination = (-1 if values.get("is_broadcast") else values["destination"]) if is_source else -2
        lines.append(f"{x:g} {y:g} {destination}\n")
    return "".join(lines)


def networks() -> list[str]:
    """Return the configurations that run."""
    configs = config_names(read_ini(FOLDER / f"{NAME}.ini"))
    return [config for config in configs if config != "General"]


def main() -> None:
    """Print one line for each station, seed and network."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--prefix", type=Path, help="directory `ns3` of the wheel on PyPI")
    parser.add_argument("--version", default="3.37")
    parser.add_argument("--phy", choices=("yans", "spectrum"), default="yans")
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--networks", nargs="*", default=networks())
    given = parser.parse_args()
    rows = csv.writer(sys.stdout, lineterminator="\n")
    rows.writerow(COLUMNS)
    with TemporaryDirectory() as folder:
        program = compiled(given.prefix, given.version, Path(folder))
        for config in given.networks:
            scenario = load_reference(NAME, config)
            for seed in range(1, given.seeds + 1):
                command = [str(program), *arguments(scenario, given.phy, seed)]
                outcome = subprocess.run(
                    command, input=stations(scenario), capture_output=True, text=True, check=True
                )
                for line in outcome.stdout.splitlines():
                    rows.writerow((given.version, given.phy, config, seed, *line.split(",")))
                sys.stdout.flush()


if __name__ == "__main__":
    main()
