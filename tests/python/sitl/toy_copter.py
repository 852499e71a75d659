#!/usr/bin/env python3
"""A small vehicle that speaks MAVLink as ArduCopter's SITL does, for tests: started with the same options.

A point without mass that flies straight at its speed, on a clock of its own that runs `--speedup` times as
fast as the wall's; with `--model JSON:...`, it steers the physics that it is told of, on their clock. What it
does wrong is in the file `misbehavior.json` beside it, by node id:

    {"1": {"refuse_arming": true}}

What it does at its end is written to a file beside it, `final_1.json`.

refuse_arming   every arming is refused, with a reason
no_fix          it never knows where it is
silent          it connects and says nothing
deaf            commands have no answer
loses_first     the first of each command has no effect and no answer
dies_at         it ends, with status 7: at "take-off", or so many seconds (its own) after SIM_SPEEDUP
leaves_at       it switches to mode LAND so many seconds after, with a reason
hangs_at        it goes on so long, and then sends nothing
old             it knows neither SET_MESSAGE_INTERVAL nor DO_SET_MODE, as ArduCopter 3
stubborn        it ignores SIGTERM
exits           it prints a line and ends with status 3 before it connects
gives_up        it connects, prints a line and does nothing any more, whatever happens
slow            its clock goes at half the pace
repeats         it asks for its next step again and again, all 50 ms of wall time
refuses_first   the first wish for a message is refused, as if that were the answer to somebody else's
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
    """Who reads it meanwhile, or after the process was killed, finds no half of it."""
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
        finally:  # again: the signal may come between the end of the connection and that of the writing
            write_whole(final, copter.state())


if __name__ == "__main__":
    main()
