# SPDX-License-Identifier: Apache-2.0
"""The same faults at one compass line, given to navcald and to Debian's gpsd, in turn in one run."""
import os
import random
import select
import shutil
import tempfile
import time

import serial_rig as rig
from faults import arguments, process

NS = rig.NS
RATE_HZ = 50
FAST_HZ = 400         # fills the buffers of a client that does not read
RETURN_LIMIT_S = 20   # navcald looks five times a second; gpsd was seen not to come back in 90 s
GONE_S = (0.05, 1.0)
KINDS = ("navcald", "gpsd")


def add(commands):
    parser = arguments.common(commands, "gpsd", "the same faults for navcald and Debian's gpsd")
    parser.add_argument("--cycles", type=int, default=100, help="hang-ups for navcald; gpsd gets 3")
    parser.add_argument("--garbage-seconds", type=float, default=40)


def command(a):
    return f"bench/reliability gpsd --cycles {a.cycles} --garbage-seconds {a.garbage_seconds:g} --seed {a.seed}"


class Line:
    """A pty at a fixed path that can be cut and put back."""

    def __init__(self, folder):
        self.folder, self.pty = folder, rig.Pty(folder, "compass")

    def cut(self):
        os.unlink(self.pty.link)
        os.close(self.pty.master)

    def put_back(self):
        self.pty = rig.Pty(self.folder, "compass")


def until_heard(line, client, first, limit_s):
    """Feeds until a record of these is answered: (seconds, next record); None when none is."""
    begin, k, client.seen = time.monotonic_ns(), first, {}
    while (passed := time.monotonic_ns() - begin) < limit_s * NS:
        line.pty.write(rig.compass_record(k)[0])
        k += 1
        select.select([client.sock], [], [], 1 / RATE_HZ)
        client.pump()
        if client.seen:
            return (min(client.seen.values()) - begin) / NS, k
        line.pty.drain()
    return None, k


def hang_ups(kind, cycles, rng):
    folder = tempfile.mkdtemp(prefix="navcal-bench-")
    line = Line(folder)
    with rig.Daemon(kind, [line.pty], folder=folder) as daemon:
        client = rig.Client(daemon.connect())
        k, _ = rig.warm_up(line.pty, client)
        returns, told, first = [], [], None
        for _ in range(cycles):
            _, k = until_heard(line, client, k, RETURN_LIMIT_S)
            lines = client.lines
            line.cut()
            cut_ns, said = time.monotonic_ns(), None
            while time.monotonic_ns() - cut_ns < rng.uniform(*GONE_S) * NS:
                select.select([client.sock], [], [], 0.01)
                client.pump()
                if said is None and client.lines > lines:
                    said = (time.monotonic_ns() - cut_ns) / NS
            told.append(said)
            line.put_back()
            back_s, k = until_heard(line, client, k, RETURN_LIMIT_S)
            if first is None and daemon.process.poll() is None:
                first = process.descriptors(daemon.process.pid)
            returns.append(back_s)
            if back_s is None:
                break
        alive = daemon.process.poll() is None
        after = process.descriptors(daemon.process.pid) if alive else None
        os.close(line.pty.master)
    back = sorted(r for r in returns if r is not None)
    return {"cycles": len(returns), "never_back": returns.count(None), "return_s": spread(back),
            "told_s": spread(sorted(t for t in told if t is not None)), "descriptors": [first, after], "alive": alive}


def spread(values):
    return {n: round(rig.quantile(values, q), 4) for n, q in (("median", 0.5), ("p99", 0.99), ("max", 1))} if values else None


def garbage(kind, seconds, rng):
    """0 to 63 random bytes before every record; no byte of them begins or ends a line by itself more often than chance has it."""
    folder = tempfile.mkdtemp(prefix="navcal-bench-")
    line = Line(folder)
    with rig.Daemon(kind, [line.pty], folder=folder) as daemon:
        client = rig.Client(daemon.connect())
        k, _ = rig.warm_up(line.pty, client)
        sent, period = {}, int(NS / RATE_HZ)
        due, count = time.monotonic_ns(), int(seconds * RATE_HZ)
        for i in range(k, k + count):
            while (left := due - time.monotonic_ns()) > 0:
                select.select([client.sock], [], [], left / NS)
                client.pump()
            data, key = rig.compass_record(i)
            now = time.monotonic_ns()
            if line.pty.write(rng.randbytes(rng.randrange(64)) + data):
                sent[key] = now
            due += period
            line.pty.drain()
        end = time.monotonic_ns() + 2 * NS
        while time.monotonic_ns() < end:
            select.select([client.sock], [], [], 0.02)
            client.pump()
        os.close(line.pty.master)
    values = rig.latencies_us(sent, client)
    return {"sent": len(sent), "kept": len(values), "p50_us": round(rig.quantile(values, 0.5), 1),
            "p99_us": round(rig.quantile(values, 0.99), 1)}


def stalled_client(kind, seconds):
    """A client that never reads: the longest silence that another one has."""
    folder = tempfile.mkdtemp(prefix="navcal-bench-")
    line = Line(folder)
    with rig.Daemon(kind, [line.pty], folder=folder) as daemon:
        client = rig.Client(daemon.connect())
        k, _ = rig.warm_up(line.pty, client)
        slow = daemon.connect(receive_buffer=4096)
        sent, _ = rig.feed(line.pty, client, FAST_HZ, int(FAST_HZ * seconds), k, tail_s=2)
        slow.close()
        os.close(line.pty.master)
    heard = sorted(client.seen[key] for key in sent if key in client.seen)
    end = max(sent.values())
    gaps = [b - a for a, b in zip(heard, heard[1:])] + [end - heard[-1] if heard else int(seconds * NS)]
    values = rig.latencies_us(sent, client)
    return {"sent": len(sent), "answered": len(values), "longest_silence_s": round(max(gaps) / NS, 3),
            "p50_us": round(rig.quantile(values, 0.5), 1), "p999_us": round(rig.quantile(values, 0.999), 1)}


def run(a):
    if shutil.which("gpsd") is None:
        arguments.skip("there is no gpsd here")
    result = {}
    for kind in KINDS:
        cycles = (a.cycles if kind == "navcald" else 3) if not a.short else 2
        result[kind] = {"hang_up": hang_ups(kind, cycles, random.Random(a.seed)),
                        "garbage": garbage(kind, 3 if a.short else a.garbage_seconds, random.Random(a.seed)),
                        "stalled_client": stalled_client(kind, 3 if a.short else 45)}
    ours, problems = result["navcald"], []
    if ours["hang_up"]["never_back"] or not ours["hang_up"]["alive"]:
        problems.append("navcald did not come back after a hang-up")
    if ours["hang_up"]["descriptors"][0] != ours["hang_up"]["descriptors"][1]:
        problems.append(f"descriptors after hang-ups: {ours['hang_up']['descriptors']}")
    if ours["garbage"]["kept"] != ours["garbage"]["sent"]:
        problems.append(f"{ours['garbage']['sent'] - ours['garbage']['kept']} intact records between garbage lost")
    return result, problems
