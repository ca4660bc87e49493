# SPDX-License-Identifier: Apache-2.0
"""What a log holds, read by the format's own page (docs/log-format.md): no code shared with navcal."""
import bisect
import json
import os
import re
import struct

MAGIC = b"\x89MCAP0\r\n"
CHANNEL, MESSAGE, METADATA = 0x04, 0x05, 0x0C
RECEIVED = 0
SAMPLE_TOPICS = ("/compass", "/imu", "/gps", "/motor")


def records(path):
    """(opcode, body) of each whole record; a torn tail ends it."""
    with open(path, "rb") as f:
        data = memoryview(f.read())
    if len(data) < len(MAGIC) and MAGIC.startswith(bytes(data)):
        return  # cut down before anything of it was written
    if bytes(data[:8]) != MAGIC:
        raise ValueError(f"{path}: no MCAP file")
    at = 8
    while at + 9 <= len(data):
        if data[at:at + 8] == MAGIC:
            return
        length = struct.unpack_from("<Q", data, at + 1)[0]
        if at + 9 + length > len(data):
            return
        yield data[at], data[at + 9:at + 9 + length]
        at += 9 + length


def text(body, at):
    """A string with its length before it, and where it ends."""
    length = struct.unpack_from("<I", body, at)[0]
    return bytes(body[at + 4:at + 4 + length]).decode(), at + 4 + length


def metadata(body):
    _, at = text(body, 0)
    end = at + 4 + struct.unpack_from("<I", body, at)[0]
    at, found = at + 4, {}
    while at < end:
        key, at = text(body, at)
        found[key], at = text(body, at)
    return found


def logs_in(folder):
    return [os.path.join(folder, f) for f in sorted(os.listdir(folder)) if f.endswith(".mcap")]


class Received:
    """All that came in by one port: its bytes in order, when each read returned, and the stamps of its samples."""

    def __init__(self):
        self.data, self.ends, self.arrivals_ns = bytearray(), [], []
        self.samples = []  # (arrival, validity), monotonic ns, and time of validity, UTC in s

    def add(self, arrival_ns, data):
        self.data += data
        self.ends.append(len(self.data))
        self.arrivals_ns.append(arrival_ns)

    def before(self, time_ns):
        """How many bytes had come before that time."""
        reads = bisect.bisect_left(self.arrivals_ns, time_ns)
        return self.ends[reads - 1] if reads else 0

    def arrival_ns(self, offset):
        """When the read that brought this byte returned."""
        return self.arrivals_ns[bisect.bisect_right(self.ends, offset)]


class Logs:
    """Over some logs, in order: `ports` by name, `events`, and the last `health`."""

    def __init__(self, paths):
        self.ports, self.events, self.health = {}, [], None
        for path in paths:
            self._read(path)

    def _read(self, path):
        topics, offset_ns = {}, 0
        for opcode, body in records(path):
            if opcode == METADATA:
                offset_ns = int(metadata(body).get("log_time_minus_monotonic_ns", offset_ns))
            elif opcode == CHANNEL:
                topics[struct.unpack_from("<H", body)[0]] = text(body, 4)[0]
            elif opcode == MESSAGE:
                channel, _, log_ns, publish_ns = struct.unpack_from("<HIQQ", body)
                self._take(topics[channel], log_ns - offset_ns, publish_ns - offset_ns, body[22:])

    def _take(self, topic, arrival_ns, validity_ns, data):
        if topic.startswith("/raw/"):
            direction, read_ns = struct.unpack_from("<Bq", data)
            if direction == RECEIVED:
                self.ports.setdefault(topic[5:], Received()).add(read_ns, bytes(data[9:-4]))
        elif topic in SAMPLE_TOPICS:
            device = re.search(rb'"device":"([a-z]+)"', bytes(data)).group(1).decode()
            utc_s = float(re.search(rb'"time":([0-9.]+)', bytes(data)).group(1))
            self.ports.setdefault(device, Received()).samples.append((arrival_ns, validity_ns, utc_s))
        elif topic == "/event":
            self.events.append(json.loads(bytes(data)))
        elif topic == "/health":
            self.health = bytes(data)


def loss_window(path, written, cut_ns):
    """(age in s, at the cut, of the oldest byte that the log lacks of what was `written` ({port: [(ns, bytes)]}); problems)."""
    problems, oldest_ns = [], cut_ns
    logs = Logs([path])
    for name, writes in written.items():
        logged = bytes(logs.ports.get(name, Received()).data)
        if not b"".join(data for _, data in writes).startswith(logged):
            problems.append(f"{os.path.basename(path)}: port {name} differs from what was written ({len(logged)} bytes)")
            continue
        done = 0
        for time_ns, data in writes:
            done += len(data)
            if done > len(logged):
                oldest_ns = min(oldest_ns, time_ns)
                break
    return (cut_ns - oldest_ns) / 1_000_000_000, problems
