#!/usr/bin/env python3
"""A small vehicle that speaks MAVLink as ArduCopter's SITL does, for tests: started with the same options.

A point without mass that flies straight at its speed, on a clock of its own that runs `--speedup` times as
fast as the wall's; with `--model JSON:...`, it steers the physics that it is told of, on their clock. What it
does wrong is in the file `misbehaviour.json` beside it, by node id:

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
import math
import select
import signal
import socket
import struct
import sys
import time
from pathlib import Path

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gradysim.sitl import quadcopter as body

GUIDED, LAND = 4, 9
EARTH_RADIUS_M = 6_371_000.0
FIX_S = 2.0
UNKNOWN = "NONESUCH"  # a parameter that it does not know


def place(latitude, longitude, north, east):
    return (
        latitude + math.degrees(north / EARTH_RADIUS_M),
        longitude + math.degrees(east / EARTH_RADIUS_M / math.cos(math.radians(latitude))),
    )


def connected(kind, address):
    """A socket, connected to an address; "tcpserver" waits there for the other side to do so."""
    if kind == "udpclient":
        udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        udp.connect(address)
        return udp
    if kind == "tcpclient":
        tcp = socket.create_connection(address)
    else:
        assert kind == "tcpserver"
        with socket.create_server(address) as server:
            tcp, _ = server.accept()
    tcp.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return tcp


class Copter:
    """Of no mass, on a clock of its own."""

    def __init__(self, options, wrongs):
        self.wrongs = wrongs
        latitude, longitude, altitude, _ = map(float, options["--home"].split(","))
        self.home = (latitude, longitude, altitude)
        self.codec = mavlink.MAVLink(None, srcSystem=int(options["--sysid"]), srcComponent=1)
        self.codec.robust_parsing = True
        kind, host, port = options["--serial0"].split(":")
        self.socket = connected(kind, (host, int(port)))
        self.speedup = float(options["--speedup"])
        self.now = 0.0  # s, on its own clock
        self.begun = math.inf  # when the simulation did
        self.wall = time.monotonic()
        self.position = [0.0, 0.0, 0.0]  # north, east, up of home; m
        self.velocity = [0.0, 0.0, 0.0]
        self.target = None
        self.until = 0.0  # when a velocity is dropped
        self.speed = 5.0
        self.mode = 0
        self.armed = False
        self.intervals = {"HEARTBEAT": 1.0}
        self.sent = {}
        self.lost = set()
        self.greetings = 0
        files = options["--defaults"].split(",")
        lines = [line for file in files for line in Path(file).read_text().splitlines()]
        self.parameters = {name: float(value) for name, value in map(str.split, lines) if name != UNKNOWN}

    def run(self):
        while self.listen(0.002):
            wall = time.monotonic()
            pace = 0.5 if self.wrongs.get("slow") else 1.0
            self.advance((wall - self.wall) * self.speedup * pace)
            self.wall = wall

    def listen(self, wait_s):
        """Obey what comes by MAVLink; whether there is still somebody."""
        readable, _, _ = select.select([self.socket], [], [], wait_s)
        data = self.socket.recv(65536) if readable else None
        for message in self.codec.parse_buffer(data) or () if data else ():
            self.obey(message)
        return data != b""

    def advance(self, dt):
        self.now += dt
        if self.wrongs.get("dies_at") != "take-off" and self.is_time_to("dies_at"):
            self.die()
        if self.is_time_to("leaves_at") and self.mode == GUIDED:
            self.mode = LAND
            self.say("Battery failsafe")
        self.move(dt)
        for name, interval in self.intervals.items():
            if self.now >= self.sent.get(name, -math.inf) + interval:
                self.sent[name] = self.now
                self.send(self.telemetry(name))

    def is_time_to(self, wrong):
        return self.now >= self.begun + self.wrongs.get(wrong, math.inf)

    def die(self):
        print("the battery exploded", flush=True)
        sys.exit(7)

    def state(self):
        moving = self.target is None and self.now < self.until
        return {
            "target": self.target,
            "speed": self.speed,
            "velocity": self.velocity if moving else None,
            "greetings": self.greetings,
            "parameters": self.parameters,
        }

    def move(self, dt):
        if self.target is not None:
            difference = [b - a for a, b in zip(self.position, self.target, strict=True)]
            distance = math.hypot(*difference)
            step = self.speed * dt
            if distance <= step:
                self.position = list(self.target)
            else:
                self.position = [
                    a + d / distance * step for a, d in zip(self.position, difference, strict=True)
                ]
        elif self.now < self.until:
            self.position = [a + v * dt for a, v in zip(self.position, self.velocity, strict=True)]

    def telemetry(self, name):
        if name == "HEARTBEAT":
            armed = mavlink.MAV_MODE_FLAG_SAFETY_ARMED if self.armed else 0
            return mavlink.MAVLink_heartbeat_message(2, 3, 1 | armed, self.mode, 4, 3)
        if name == "GLOBAL_POSITION_INT":
            latitude, longitude = place(*self.home[:2], *self.position[:2])
            height = self.position[2]
            return mavlink.MAVLink_global_position_int_message(
                round(self.now * 1000),
                round(latitude * 1e7),
                round(longitude * 1e7),
                round((self.home[2] + height) * 1000),
                round(height * 1000),
                *([0] * 4),
            )
        if name == "EKF_STATUS_REPORT":
            flags = mavlink.EKF_POS_HORIZ_ABS if self.now > FIX_S and not self.wrongs.get("no_fix") else 0
            return mavlink.MAVLink_ekf_status_report_message(flags, *([0.0] * 5))
        if name == "EXTENDED_SYS_STATE":
            landed = 2 if self.position[2] > 0.5 else 1
            return mavlink.MAVLink_extended_sys_state_message(0, landed)
        assert name == "SYS_STATUS"
        battery = 100 - int(self.now // 10)
        return mavlink.MAVLink_sys_status_message(0, 0, 0, 0, 12000, 0, battery, *([0] * 6))

    def send(self, message):
        if not self.wrongs.get("silent") and not self.is_time_to("hangs_at"):
            self.socket.sendall(message.pack(self.codec))

    def say(self, text):
        self.send(mavlink.MAVLink_statustext_message(mavlink.MAV_SEVERITY_CRITICAL, text.encode()))

    def obey(self, message):
        kind = message.get_type()
        if kind == "COMMAND_LONG":
            assert message.target_system == self.codec.srcSystem
            if self.wrongs.get("loses_first") and message.command not in self.lost:
                self.lost.add(message.command)
                return
            result = self.command(message)
            if not self.wrongs.get("deaf"):
                self.send(mavlink.MAVLink_command_ack_message(message.command, result))
        elif kind == "HEARTBEAT":
            self.greetings += 1
        elif kind == "SET_MODE":
            self.mode = message.custom_mode
        elif kind == "REQUEST_DATA_STREAM":
            names = {
                mavlink.MAV_DATA_STREAM_POSITION: ["GLOBAL_POSITION_INT"],
                mavlink.MAV_DATA_STREAM_EXTENDED_STATUS: ["SYS_STATUS"],
                mavlink.MAV_DATA_STREAM_EXTRA3: ["EKF_STATUS_REPORT"],
            }
            for name in names[message.req_stream_id]:
                self.intervals[name] = 1 / message.req_message_rate
        elif kind == "PARAM_SET" and message.param_id in self.parameters:
            self.send(
                mavlink.MAVLink_param_value_message(message.param_id.encode(), message.param_value, 9, 1, 0)
            )
        elif kind == "PARAM_SET" and message.param_id == "SIM_SPEEDUP":
            self.speedup = message.param_value
            self.begun = self.now
            self.send(mavlink.MAVLink_param_value_message(b"SIM_SPEEDUP", self.speedup, 9, 1, 0))
        elif kind == "SET_POSITION_TARGET_GLOBAL_INT" and self.mode == GUIDED and self.armed:
            latitude, longitude = message.lat_int / 1e7, message.lon_int / 1e7
            if latitude == 0 and longitude == 0:
                return
            north = math.radians(latitude - self.home[0]) * EARTH_RADIUS_M
            east = (
                math.radians(longitude - self.home[1]) * EARTH_RADIUS_M * math.cos(math.radians(self.home[0]))
            )
            if self.target is None:
                self.speed = 5.0
            self.target = [north, east, message.alt]
        elif kind == "SET_POSITION_TARGET_LOCAL_NED" and self.mode == GUIDED and self.armed:
            self.target = None
            self.velocity = [message.vx, message.vy, -message.vz]
            self.until = self.now + 3.0

    def command(self, message):
        accepted, failed, unsupported = 0, 4, 3
        if message.command == mavlink.MAV_CMD_SET_MESSAGE_INTERVAL:
            if self.wrongs.get("old"):
                return unsupported
            if self.wrongs.pop("refuses_first", False):
                return failed
            self.intervals[mavlink.mavlink_map[int(message.param1)].msgname] = message.param2 / 1e6
            return accepted
        if message.command == mavlink.MAV_CMD_DO_SET_MODE:
            if self.wrongs.get("old"):
                return unsupported
            self.mode = int(message.param2)
            return accepted
        if message.command == mavlink.MAV_CMD_COMPONENT_ARM_DISARM:
            if self.wrongs.get("refuse_arming"):
                self.say("PreArm: Compass not calibrated")
                return failed
            self.armed = True
            return accepted
        if message.command == mavlink.MAV_CMD_NAV_TAKEOFF:
            if not self.armed or self.mode != GUIDED:
                return failed
            if self.wrongs.get("dies_at") == "take-off":
                self.die()
            self.target = [*self.position[:2], message.param7]
            return accepted
        if message.command == mavlink.MAV_CMD_DO_CHANGE_SPEED:
            if message.param2 <= 0:
                return failed
            self.speed = message.param2
            return accepted
        return unsupported


class LockStepCopter(Copter):
    """Waits for its physics at each step. It knows where it is, and steers like a cautious beginner."""

    RATE_HZ = 100

    def __init__(self, options, wrongs):
        super().__init__(options, wrongs)
        self.physics = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.physics.connect(("127.0.0.1", int(options["--sim-port-out"])))
        self.physics.settimeout(0.05 if wrongs.get("repeats") else 1.0)
        self.felt = {"imu": {"gyro": [0] * 3}, "quaternion": [1, 0, 0, 0], "velocity": [0] * 3}
        self.frames = self.repeats = 0

    def run(self):
        self.take_step()
        while self.listen(0):
            self.advance(1 / self.RATE_HZ)
            self.take_step()

    def take_step(self):
        while self.is_time_to("hangs_at"):
            time.sleep(60)
        self.frames += 1
        servos = struct.pack("<HHI16H", 18458, self.RATE_HZ, self.frames, *self.pulses(), *([0] * 12))
        self.physics.send(servos)
        while True:
            try:
                text = self.physics.recv(4096)
            except TimeoutError:
                self.repeats += 1
                self.physics.send(servos)
                continue
            self.felt = json.loads(text)
            break
        assert (text[:1], text[-1:]) == (b"\n", b"\n")
        north, east, down = self.felt["position"]
        self.position = [north, east, -down]
        assert self.felt["timestamp"] > self.now
        self.now = self.felt["timestamp"] - 1 / self.RATE_HZ  # to which `advance` adds a step

    def move(self, dt):
        """The physics do."""

    def command(self, message):
        if message.command == mavlink.MAV_CMD_DO_CHANGE_SPEED:  # the last one before the simulation starts
            self.begun = min(self.begun, self.now)
        return super().command(message)

    def pulses(self):
        """Microseconds: the throttles that turn it to where it is to accelerate to."""
        if not self.armed or (self.target is None and self.now >= self.until):
            return [1000 + 450 * self.armed * (self.position[2] > 0.5)] * 4
        wanted, drag = self.wanted_velocity(), body.DRAG_KGPS / body.MASS_KG
        north, east, down = self.felt["velocity"]
        forward, right = (
            max(-4, min(4, 1.5 * (want - has) + drag * has))
            for want, has in zip(wanted[:2], (north, east), strict=True)
        )
        rise = max(-3, min(3, 2 * (wanted[2] + down) - drag * down))
        w, x, y, z = self.felt["quaternion"]
        roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
        pitch = math.asin(max(-1, min(1, 2 * (w * y - z * x))))
        p, q, r = self.felt["imu"]["gyro"]
        g = body.GRAVITY_MPS2
        ix, iy, iz = body.INERTIA_KGM2
        lever = 4 * body.ARM_M * math.sqrt(0.5)
        by_roll = ix * (36 * (right / g - roll) - 10 * p) / lever
        by_pitch = iy * (36 * (-forward / g - pitch) - 10 * q) / lever
        by_yaw = -iz * 4 * r / (4 * body.TORQUE_M)
        lift = body.MASS_KG * (g + rise) / (4 * max(0.5, math.cos(roll) * math.cos(pitch)))
        thrusts = [
            lift - by_roll + by_pitch + by_yaw,
            lift + by_roll - by_pitch + by_yaw,
            lift + by_roll + by_pitch - by_yaw,
            lift - by_roll - by_pitch - by_yaw,
        ]
        return [round(1000 + 1000 * self.throttle(thrust)) for thrust in thrusts]

    def wanted_velocity(self):
        if self.target is None:
            return self.velocity
        way = [b - a for a, b in zip(self.position, self.target, strict=True)]
        distance = math.hypot(*way)
        return [each / max(distance, 1e-9) * min(self.speed, distance) for each in way]

    def throttle(self, thrust):
        greatest = body.MASS_KG * body.GRAVITY_MPS2 / (4 * body.HOVER_THRUST)
        share, e = max(0, min(1, thrust / greatest)), body.THRUST_EXPO
        return (math.sqrt((1 - e) ** 2 + 4 * e * share) - (1 - e)) / (2 * e)


def end_once(number, frame):
    signal.signal(number, signal.SIG_IGN)
    sys.exit()


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
    file = Path(__file__).with_name("misbehaviour.json")
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
            final.write_text(json.dumps(copter.state()))
        finally:  # again: the signal may come between the end of the connection and that of the writing
            final.write_text(json.dumps(copter.state()))


if __name__ == "__main__":
    main()
