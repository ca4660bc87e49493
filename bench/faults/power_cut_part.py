# SPDX-License-Identifier: Apache-2.0
"""Power cuts of a virtual machine while navcald logs in it (bench/power_cut)."""
import os
import random
import shutil
import sys
import tempfile
import time

import serial_rig as rig
from faults import arguments, machine
from faults.kill_part import SYNC_S, finished, imu_frame, whole
from faults.log_bytes import logs_in, loss_window

RATE_HZ = 20
BOOT_LIMIT_S = 900
LEAST_S, MOST_S = 3, 9


def command(a):
    return f"bench/power_cut --cuts {a.cuts} --seed {a.seed}"


class Cycle:
    def __init__(self, guest, first_frame):
        self.guest, self.k = guest, first_frame
        self.written = {"a": [], "b": []}

    def await_word(self, what):
        end = time.monotonic() + BOOT_LIMIT_S
        while not self.guest.said(what):
            if self.guest.process.poll() is not None or time.monotonic() > end:
                raise SystemExit(f"no word of the machine: see {self.guest.folder}")
            time.sleep(0.2)

    def feed(self, seconds):
        """From when the machine is up: what is sent before waits at its door, and would be counted as lost."""
        self.guest.connect()
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.frame()
            time.sleep(1 / RATE_HZ)

    def frame(self):
        for name, uart in zip(self.written, self.guest.uarts):
            data = imu_frame(self.k)
            self.k += 1
            uart.sendall(data)
            self.written[name].append((time.monotonic_ns(), data))

    def loss(self, path):
        """(age in s of the oldest byte at the cut that the log lacks; problems)."""
        return loss_window(path, self.written, self.cut_ns)


def cut_once(guest, k, rng, seen, words=""):
    begin = time.monotonic()
    guest.start(words)
    cycle = Cycle(guest, k)
    cycle.await_word("looked" if words else "booted")
    cycle.boot_s = time.monotonic() - begin
    cycle.feed(rng.uniform(LEAST_S, MOST_S))
    cycle.cut_ns = time.monotonic_ns()
    guest.cut()
    cycle.words = {what: guest.said(what) for what in ("booted", "status", "watchdog", "again", "seccomp")}
    cycle.fsck = guest.check()
    folder = guest.take_logs(os.path.join(guest.folder, "logs"))
    new = [path for path in logs_in(folder) if os.path.basename(path) not in seen]
    seen.update(os.path.basename(path) for path in new)
    cycle.torn = sum(os.path.getsize(path) > whole(path)[0] for path in new)
    # With a watchdog's restart there are two: the last is the one that was cut.
    cycle.loss_s, cycle.problems = cycle.loss(new[-1]) if new else (None, ["there is no new log"])
    if cycle.fsck not in (0, 1):
        cycle.problems.append(f"file system: {cycle.fsck}")
    return cycle, folder


def run(a):
    for program in ("qemu-system-x86_64", "debootstrap", "e2fsck", "debugfs"):
        if shutil.which(program) is None:
            arguments.skip(f"there is no {program} here")
    machine.make_root()
    folder = tempfile.mkdtemp(prefix="navcal-reliability-")
    rng, guest = random.Random(a.seed), machine.Machine(folder, a.memory_MB)
    cycles, seen, problems, k, logs = [], set(), [], 0, None
    try:
        for i in range(a.cuts):
            cycle, logs = cut_once(guest, k, rng, seen, "" if i else "navcal.look")
            k = cycle.k
            cycles.append(cycle)
            problems += cycle.problems
            print(f"cut {i + 1}: boot {cycle.boot_s:.0f} s, loss {cycle.loss_s} s, fsck {cycle.fsck}, {cycle.words}",
                  file=sys.stderr, flush=True)
    finally:
        guest.cut()
    # All but the last were finished by the boot after their cut.
    unreadable = sum(finished(path) is None for path in logs_in(logs))
    if unreadable:
        problems.append(f"{unreadable} logs cannot be read")
    if problems or a.keep:
        print(f"kept: {folder}", file=sys.stderr)
    else:
        shutil.rmtree(folder, ignore_errors=True)
    losses = sorted(c.loss_s for c in cycles if c.loss_s is not None)
    return {"cuts": len(cycles), "sync_interval_s": SYNC_S, "service": cycles[0].words,
            "loss_window_s": {n: round(rig.quantile(losses, q), 3) for n, q in (("median", 0.5), ("max", 1))},
            "boot_s": round(rig.median([c.boot_s for c in cycles])), "torn_tails": sum(c.torn for c in cycles),
            "fsck_bad": sum(c.fsck not in (0, 1) for c in cycles), "logs": len(seen), "unreadable": unreadable}, problems
