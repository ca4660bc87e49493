#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""An autopilot with an encoder of its own: sends MAVLink 2 to a UDP port and answers what is asked.

Its clock is 30 ppm fast; each frame is sent 1 ms + 0 to 20 ms after its time. After half of the time it restarts: its
clock begins anew. It has added -50 mGauss to the first axis of its compass. The file that it writes has the true time of each inertial reading, what was sent, and what came.
"""

import argparse
import collections
import json
import random
import select
import socket
import struct
import time

EXTRA = {0: 50, 20: 214, 22: 220, 27: 144, 30: 39, 36: 222, 76: 152, 77: 143, 132: 85, 137: 195}
LENGTH = {132: 39}


def crc_of(data):
    crc = 0xFFFF
    for byte in data:
        mixed = (byte ^ crc) & 0xFF
        mixed = (mixed ^ (mixed << 4)) & 0xFF
        crc = (crc >> 8) ^ (mixed << 8) ^ (mixed << 3) ^ (mixed >> 4)
    return crc


def utc_offset():
    """UTC less the monotonic clock: of the quickest of many comparisons, since others run too."""

    def compared():
        before = time.monotonic()
        utc = time.time()
        after = time.monotonic()
        return after - before, utc - (before + after) / 2

    return min(compared() for _ in range(200))[1]


class Autopilot:
    def __init__(self, port, seconds):
        self.to = ("127.0.0.1", port)
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.seconds = seconds
        self.sequence = 0
        self.sent = collections.Counter()
        self.times = []
        self.came = []
        self.restarted = None

    def frame(self, number, payload, sender=(1, 1), untrimmed=False):
        def body(data, length):
            return struct.pack("<BBBBBB", length, 0, 0, self.sequence, *sender) + struct.pack("<I", number)[:3] + data

        cut = payload.rstrip(b"\0") or payload[:1]
        whole = payload.ljust(LENGTH.get(number, 0), b"\0") if untrimmed else cut
        crc = crc_of(body(whole, len(whole)) + bytes([EXTRA[number]]))
        frame = b"\xfd" + body(cut, len(cut)) + struct.pack("<H", crc)
        self.sequence = (self.sequence + 1) & 0xFF
        self.sent[number] += 1
        return frame

    def send(self, frame):
        self.socket.sendto(frame, self.to)

    def boot_us(self, at):
        start = self.start if self.restarted is None or at < self.restarted else self.restarted
        return int((at - start) * (1 + 30e-6) * 1e6) + 1_000_000

    def frames_at(self, tick, at):
        boot_us = self.boot_us(at)
        self.times.append(at + self.utc)
        if tick % 50 == 0:
            yield self.frame(0, struct.pack("<IBBBBB", 0, 12, 3, 81, 4, 3))
            yield self.frame(0, struct.pack("<IBBBBB", 0, 6, 8, 0, 0, 3), (255, 190))
        yield self.frame(27, struct.pack("<Q9h", boot_us, 0, 0, -1000, tick, 0, 0, 200 + tick // 5, -50, 430))
        if tick % 2 == 0:
            yield self.frame(30, struct.pack("<I6f", boot_us // 1000, 0.1, -0.2, 1.5, 0, 0, 0))
            yield self.frame(36, struct.pack("<I8HB", boot_us & 0xFFFFFFFF, 1500, 1600, 0, 0, 0, 0, 0, 0, 0))
        if tick % 5 == 0:
            yield self.frame(137, struct.pack("<Iffh", boot_us // 1000, 1500, 0, 1200))
            distance = struct.pack("<IHHHBBBB", boot_us // 1000 + 500_000, 30, 5000, 250, 1, 1, 25, 255)
            yield self.frame(132, distance, (1, 194), untrimmed=tick % 10 == 0)

    def answer(self, data):
        number = data[7] | data[8] << 8 | data[9] << 16
        payload = data[10 : 10 + data[1]].ljust(33, b"\0")
        good = crc_of(data[1 : 10 + data[1]] + bytes([EXTRA[number]])) == struct.unpack("<H", data[10 + data[1] :])[0]
        what = {"id": number, "system": data[5], "component": data[6], "good": good, "again": self.restarted is not None}
        if number == 76:
            what["message"], what["interval_us"] = struct.unpack_from("<ff", payload)
            result = 3 if what["message"] == 105 else 0  # it does not have HIGHRES_IMU
            self.send(self.frame(77, struct.pack("<HBBiBB", 511, result, 0, 0, data[5], data[6])))
        if number == 20:
            what["parameter"] = payload[4:20].rstrip(b"\0").decode()
            value = 1 if "_DIA_" in what["parameter"] else -50 if what["parameter"] == "COMPASS_OFS_X" else 0
            self.send(self.frame(22, struct.pack("<fHH16sB", value, 900, 65535, what["parameter"].encode(), 9)))
        self.came.append(what)

    def wait_until(self, at):
        while (left := at - time.monotonic()) > 0:
            if select.select([self.socket], [], [], left)[0]:
                data = self.socket.recv(2000)
                while data:  # a datagram may hold several frames
                    self.answer(data[: data[1] + 12])
                    data = data[data[1] + 12 :]

    def run(self):
        rng = random.Random(1)
        self.start = time.monotonic()
        self.utc = utc_offset()
        half = int(self.seconds * 25)
        pause = 0
        for tick in range(2 * half):
            if tick == half:
                pause = 1
                self.restarted = self.start + tick * 0.02 + pause
            at = self.start + tick * 0.02 + pause
            frames = list(self.frames_at(tick, at))
            self.wait_until(at + 0.001 + rng.uniform(0, 0.02))
            for frame in frames:
                self.send(frame)
        self.wait_until(time.monotonic() + 1)


parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("port", type=int)
parser.add_argument("seconds", type=float)
parser.add_argument("truth")
arguments = parser.parse_args()
autopilot = Autopilot(arguments.port, arguments.seconds)
autopilot.run()
with open(arguments.truth, "w") as file:
    json.dump({"times": autopilot.times, "sent": autopilot.sent, "came": autopilot.came}, file)
