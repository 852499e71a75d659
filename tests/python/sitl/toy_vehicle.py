"""The vehicle of `toy_copter.py`: a point without mass that flies straight, on its own clock."""

import contextlib
import math
import select
import socket
import sys
import time
from pathlib import Path

from pymavlink.dialects.v20 import ardupilotmega as mavlink

GUIDED, LAND = 4, 9
EARTH_RADIUS_M = 6_371_000.0
FIX_S = 2.0
UNKNOWN = "NONESUCH"  # a parameter that does not exist


def place(latitude, longitude, north, east):
    return (
        latitude + math.degrees(north / EARTH_RADIUS_M),
        longitude + math.degrees(east / EARTH_RADIUS_M / math.cos(math.radians(latitude))),
    )


def connected(kind, address):
    """Return a socket connected to an address; "tcpserver" waits there for the other side to connect."""
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
    """Vehicle without mass, on its own clock."""

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
        self.until = 0.0  # end of a velocity
        self.landed = True  # its own view; then it obeys only take-off and upward velocities
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
        """Obey incoming MAVLink messages; return whether the connection is open."""
        readable, _, _ = select.select([self.socket], [], [], wait_s)
        try:
            data = self.socket.recv(65536) if readable else None
        except ConnectionResetError:  # the other side left during telemetry
            data = b""
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
        self.notice_ground()
        if not self.landed:
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

    def notice_ground(self):
        if self.target is None and self.now < self.until:
            rise = self.velocity[2]
            self.landed = self.position[2] <= 0.01 and rise < 0 if not self.landed else rise <= 0

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
            self.position[2] = max(0.0, self.position[2])

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
            return mavlink.MAVLink_extended_sys_state_message(0, 1 if self.landed else 2)
        assert name == "SYS_STATUS"
        battery = 100 - int(self.now // 10)
        return mavlink.MAVLink_sys_status_message(0, 0, 0, 0, 12000, 0, battery, *([0] * 6))

    def send(self, message):
        if not self.wrongs.get("silent") and not self.is_time_to("hangs_at"):
            with contextlib.suppress(ConnectionResetError, BrokenPipeError):  # `listen` notices it
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
            self.landed = False
            return accepted
        if message.command == mavlink.MAV_CMD_DO_CHANGE_SPEED:
            if message.param2 <= 0:
                return failed
            self.speed = message.param2
            return accepted
        return unsupported
