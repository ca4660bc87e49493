# SPDX-License-Identifier: Apache-2.0
"""One port after the run: what of its line reached navcald, which intact frames were decoded, which became samples."""
import bisect
import json
import subprocess
import tempfile

from faults import frames
from faults.emulator import navcal_binary

IN_FLIGHT_NS = 1_000_000_000  # a byte written this long before a line was cut has been read, however busy the machine
TORN_NS = 200_000_000  # navcald gives a frame up that pauses for 250 ms (docs/timing.md); read it may be in less


def decoded(protocol, data):
    """{(begin, end)} of all frames that `navcal decode` finds."""
    with tempfile.NamedTemporaryFile() as f:
        f.write(data)
        f.flush()
        out = subprocess.run([navcal_binary(), "decode", "--protocol", protocol, "--json", f.name], check=True,
                             capture_output=True, text=True).stdout
    found = [json.loads(line) for line in out.splitlines()]
    return {(f["offset"], f["offset"] + f["length"]) for f in found if f["class"] == "FRAME"}


class Reached:
    """What of one line reached navcald, according to the log: lives one after another, and what is not right."""

    def __init__(self, line, received):
        self.line, self.received = line, received
        self.begins, self.data = [], bytearray()
        self.wrong = self.in_flight = self.missing = 0
        for k, life in enumerate(line.lives):
            next_ns = line.lives[k + 1].begun_ns if k + 1 < len(line.lives) else 1 << 62
            logged = received.data[received.before(life.begun_ns):received.before(next_ns)]
            self.begins.append(len(self.data))
            self.data += logged
            if not life.data.startswith(logged):
                self.wrong += 1
            rest = len(life.data) - len(logged)
            if rest > 0:
                early = life.written_ns(len(logged)) < life.ended_ns - IN_FLIGHT_NS
                self.missing += rest if early else 0
                self.in_flight += 0 if early else rest
        self.written = sum(len(life.data) for life in line.lives)

    def in_window(self, begin_ns, end_ns):
        """(bytes written, bytes of them in the log) between two times."""
        written = logged = 0
        for k, life in enumerate(self.line.lives):
            first, last = (bisect.bisect_left(life.times_ns, t) for t in (begin_ns, end_ns))
            a, b = (life.ends[i - 1] if i else 0 for i in (first, last))
            reached = (self.begins[k + 1] if k + 1 < len(self.begins) else len(self.data)) - self.begins[k]
            written += b - a
            logged += max(0, min(b, reached) - a)
        return written, logged

    def life_of(self, offset):
        return bisect.bisect_right(self.begins, offset) - 1

    def is_torn(self, begin, end):
        """Whether the writes of a frame paused for so long that it counts as two pieces."""
        k = self.life_of(begin)
        if k != self.life_of(end - 1):
            return True
        return self.line.lives[k].longest_pause_ns(begin - self.begins[k], end - self.begins[k]) > TORN_NS

    def written_ns(self, offset):
        k = self.life_of(offset)
        return self.line.lives[k].written_ns(offset - self.begins[k])


class Port:
    """One port after the run: its intact frames, which were decoded, which became samples, and when."""

    def __init__(self, line, logs):
        self.name = line.name
        self.reached = Reached(line, logs.ports[line.name])
        data = bytes(self.reached.data)
        found = frames.intact(line.protocol, data)
        self.all_decoded = decoded(line.protocol, data)
        self.frames = found
        self.times_ns = [self.reached.written_ns(end - 1) for _, end in found]
        self.lost = [f for f in found if f not in self.all_decoded]
        said = set(bytes(line.said[a:b]) for a, b in frames.intact(line.protocol, line.said))
        # A checksum of eight bits lets one damaged frame of 256 pass; the protocol has no other.
        genuine = [data[a:b] in said for a, b in found]
        self.damaged = genuine.count(False)
        received = self.reached.received
        sampled = {arrival for arrival, _, _ in received.samples}
        self.is_sample = [frames.is_sample(line.protocol, data[a:b]) for a, b in found]
        # The same frame twice in a row is one measurement.
        repeats = [k > 0 and data[a:b] == data[slice(*found[k - 1])] for k, (a, b) in enumerate(found)]
        missed = [sample and true and not again and received.arrival_ns(end - 1) not in sampled
                  for sample, true, again, (_, end) in zip(self.is_sample, genuine, repeats, found)]
        torn = [miss and self.reached.is_torn(*frame) for miss, frame in zip(missed, found)]
        self.torn = sum(torn)
        self.unsampled = [miss and not apart for miss, apart in zip(missed, torn)]
        health = next(p for p in json.loads(logs.health)["ports"] if p["device"] == line.name)
        self.live_frames, self.clock = health["frames"], health["clock"]

    def between(self, begin_ns, end_ns):
        return range(bisect.bisect_left(self.times_ns, begin_ns), bisect.bisect_left(self.times_ns, end_ns))

    def stamp_errors_us(self):
        """(time of writing, arrival minus writing of the last byte) of each read."""
        received = self.reached.received
        for end, arrival_ns in zip(received.ends, received.arrivals_ns):
            written_ns = self.reached.written_ns(end - 1)
            yield written_ns, (arrival_ns - written_ns) / 1000
