#!/usr/bin/env python3
"""A small vehicle that speaks MAVLink like ArduCopter's SITL, for tests. It takes the same options.

It is a point without mass that flies straight at its speed. Its clock runs `--speedup` times as fast as wall
time. With `--model JSON:...` it steers external physics, on their clock. Its faults are in the file
`misbehavior.json` next to it, by node id:

    {"1": {"refuse_arming": true}}

Its final state is written to a file next to it, `final_1.json`.

refuse_arming   every arming is rejected, with a reason
no_fix          it never has a position
silent          it connects and sends nothing
deaf            commands are not answered
loses_first     the first of each command has no effect and no answer
dies_at         it exits with status 7: at "take-off", or this many seconds (its own) after SIM_SPEEDUP
leaves_at       it switches to mode LAND this many seconds after, with a reason
hangs_at        it continues this many seconds, and then sends nothing
old             it supports neither SET_MESSAGE_INTERVAL nor DO_SET_MODE, like ArduCopter 3
stubborn        it ignores SIGTERM
exits           it prints a line and exits with status 3 before it connects
gives_up        it connects, prints a line and then does nothing
slow            its clock runs at half the pace
repeats         it repeats its request for the next step, every 50 ms of wall time
refuses_first   the first request for a message is rejected, as if the answer were for another program
"""

import json
import signal
import sys
import time
from pathlib import Path

from toy_lock_step import LockStepCopter
from toy_vehicle import Copter


def end_once(number, frame):
    signal.signal(number, signal.SIG_IGN)
    sys.exit()


def write_whole(file, state):
    """Write a file as a whole, for readers at the same time, or after a kill."""
    draft = file.with_suffix(".draft")
    draft.write_text(json.dumps(state))
    draft.replace(file)


def main():
    if sys.argv[1:] == ["--help"]:
        print(
            "options: --wipe --model --home --defaults --uartA --serial0 --speedup --instance --sysid "
            "--sim-port-out"
        )
        return
    arguments = [argument for argument in sys.argv[1:] if argument != "--wipe"]
    options = dict(zip(arguments[::2], arguments[1::2], strict=True))
    (Path.cwd() / "eeprom.bin").write_bytes(b"")
    wrongs = {}
    file = Path(__file__).with_name("misbehavior.json")
    if file.exists():
        wrongs = json.loads(file.read_text()).get(Path.cwd().name, {})
    if wrongs.get("exits"):
        print("no such model", flush=True)
        sys.exit(3)
    if wrongs.get("stubborn"):
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
    else:
        signal.signal(signal.SIGTERM, end_once)
    kind = LockStepCopter if options["--model"].startswith("JSON") else Copter
    copter = kind(options, wrongs)
    if wrongs.get("gives_up"):
        print("invalid param", flush=True)
        while True:
            time.sleep(60)
    final = Path(__file__).with_name(f"final_{Path.cwd().name}.json")
    try:
        copter.run()
    finally:
        try:
            write_whole(final, copter.state())
        finally:  # again: the signal may come between the end of the connection and the end of the write
            write_whole(final, copter.state())


if __name__ == "__main__":
    main()
