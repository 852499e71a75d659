"""The vehicle of `toy_copter.py` in lock-step with its physics."""

import json
import math
import socket
import struct
import time

from pymavlink.dialects.v20 import ardupilotmega as mavlink
from toy_vehicle import Copter

from gradysim.motion import quadcopter as body


class LockStepCopter(Copter):
    """Knows its position, and steers with a simple controller."""

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
        self.now = self.felt["timestamp"] - 1 / self.RATE_HZ  # `advance` adds a step

    def move(self, dt):
        """Do nothing: the physics move it."""

    def command(self, message):
        if (
            message.command == mavlink.MAV_CMD_DO_CHANGE_SPEED
        ):  # the last command before the simulation starts
            self.begun = min(self.begun, self.now)
        return super().command(message)

    def pulses(self):
        """Return pulse widths in microseconds: throttles that turn it towards its target acceleration."""
        if not self.armed or self.landed or (self.target is None and self.now >= self.until):
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
