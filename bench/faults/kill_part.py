# SPDX-License-Identifier: Apache-2.0
"""SIGKILL at random times while logging: what each log holds of what had been written, and the next start."""
import json
import os
import random
import select
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time

import serial_rig as rig
from faults import arguments, frames
from faults.emulator import navcal_binary
from faults.log_bytes import logs_in, loss_window, records

SYNC_S = 1  # the shipped log.sync_interval_s
NS = rig.NS
RATE_HZ = 100
LEAST_S, MOST_S = 0.02, 2.2


def add(commands):
    parser = arguments.common(commands, "kill", "SIGKILL at random times while logging")
    parser.add_argument("--kills", type=int, default=500)


def command(a):
    return f"bench/reliability kill --kills {a.kills} --seed {a.seed}"


def imu_frame(k):
    body = struct.pack(">BB8H", k & 0xFF, 0, *[k >> 8 & 0xFFF] * 8)
    return frames.IMU_SYNC + body + struct.pack(">H", frames.crc16(body))


class CardDaemon(rig.Daemon):
    """Two inertial cards: no frame is like another."""

    free_floor_MB = 1

    def write_config(self, ptys, log):
        os.makedirs(self.log_folder, exist_ok=True)
        path = os.path.join(self.folder, "navcald.toml")
        with open(path, "w") as f:
            f.write(f'[log]\ndirectory = "{self.log_folder}"\nfree_floor_MB = {self.free_floor_MB}\nsync_interval_s = {SYNC_S}\n'
                    f'[status]\nport = {self.port}\n[control]\nsocket = "{self.folder}/control"\n')
            for p in ptys:
                f.write(f'[port.{os.path.basename(p.link)}]\nprotocol = "imu-card"\npath = "{p.link}"\n'
                        f'baud = 57600\nrate_Hz = {RATE_HZ}\n')
        return path


def whole(path):
    """(length of all whole records, length of the file); raises when a whole record cannot be read."""
    size = os.path.getsize(path)
    return min(size, 8 + sum(9 + len(body) for _, body in records(path))), size


class Cycle:
    """One start, some data, one kill; and what the log then holds."""

    def __init__(self, folder, first_frame, run_s):
        self.written = {name: [] for name in ("a", "b")}  # (time, bytes)
        ptys = [rig.Pty(folder, name) for name in self.written]
        before = set(logs_in(f"{folder}/log")) if os.path.isdir(f"{folder}/log") else set()
        daemon = CardDaemon("navcald", ptys, folder=folder)
        try:
            sock = daemon.connect()
            self.start_s = (time.monotonic_ns() - daemon.started_ns) / NS
            self.wait_until_open(ptys)
            self.next_frame = self.feed(ptys, sock, first_frame, run_s)
            self.killed_ns = time.monotonic_ns()
            daemon.process.send_signal(signal.SIGKILL)
        finally:
            if daemon.process.poll() is None and not hasattr(self, "killed_ns"):
                daemon.process.kill()
            daemon.process.wait()
            daemon.errors.close()
            for p in ptys:
                os.close(p.master)
                os.unlink(p.link)
        sock.close()
        self.errors = daemon.errors.name
        new = sorted(set(logs_in(f"{folder}/log")) - before)
        self.log = new[0] if len(new) == 1 else None

    @staticmethod
    def wait_until_open(ptys):
        poll = select.poll()
        for p in ptys:
            poll.register(p.master, select.POLLOUT)
        end = time.monotonic() + 15
        while any(event & select.POLLHUP for _, event in poll.poll(0)) and time.monotonic() < end:
            time.sleep(0.002)

    def feed(self, ptys, sock, k, run_s):
        end = time.monotonic() + run_s
        while (now := time.monotonic()) < end:
            for p in ptys:
                data = imu_frame(k)
                if p.write(data):
                    self.written[os.path.basename(p.link)].append((time.monotonic_ns(), data))
                k += 1
            try:
                while sock.recv(65536):
                    pass
            except BlockingIOError:
                pass
            time.sleep(max(0, min(1 / RATE_HZ, end - now)))
        return k

    def judge(self):
        """(loss window in s: age of the oldest byte that is missing, at the kill; problems)."""
        if self.log is None:
            return 0, ["there is not exactly one new log"]
        length, size = whole(self.log)
        self.torn = size - length
        return loss_window(self.log, self.written, self.killed_ns)


def finished(path):
    """What `navcal log info` says of a log; None when it cannot read it."""
    out = subprocess.run([navcal_binary(), "log", "info", "--json", path], capture_output=True, text=True)
    return json.loads(out.stdout) if out.returncode == 0 else None


def run(a):
    kills = 6 if a.short else a.kills
    rng, folder = random.Random(a.seed), tempfile.mkdtemp(prefix="navcal-reliability-")
    losses, starts, torn, problems, k = [], [], 0, [], 0
    for i in range(kills + 1):
        cycle = Cycle(folder, k, rng.uniform(LEAST_S, MOST_S))
        k = cycle.next_frame
        loss_s, found = cycle.judge()
        losses.append(loss_s)
        starts.append(cycle.start_s)
        torn += getattr(cycle, "torn", 0) > 0
        problems += found
        if i % 50 == 49:
            print(f"{i + 1} kills", file=sys.stderr, flush=True)
    # Each start but the last has finished the log of the kill before it.
    logs = logs_in(f"{folder}/log")[:-1]
    infos = [finished(path) for path in logs]
    unreadable = sum(info is None for info in infos)
    writable = sum(os.stat(path).st_mode & 0o222 != 0 for path in logs)
    if unreadable or writable:
        problems.append(f"after the next start {unreadable} logs cannot be read and {writable} are not finished")
    if problems or a.keep:
        print(f"kept: {folder}", file=sys.stderr)
    else:
        shutil.rmtree(folder, ignore_errors=True)
    losses.sort()
    starts.sort()
    return {"kills": len(losses), "sync_interval_s": SYNC_S, "bytes_per_s": 2 * RATE_HZ * frames.IMU_BYTES,
            "loss_window_s": {n: round(rig.quantile(losses, q), 3) for n, q in
                              (("median", 0.5), ("p99", 0.99), ("max", 1))},
            "over_the_interval": sum(s > SYNC_S for s in losses), "torn_tails": torn, "logs_finished": len(logs) - writable,
            "unreadable": unreadable, "start_s": {"median": round(rig.quantile(starts, 0.5), 3),
                                                  "max": round(starts[-1], 3)}}, problems
