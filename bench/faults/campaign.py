# SPDX-License-Identifier: Apache-2.0
"""Randomised faults at the lines of a running navcald, one after another; what was done and seen, for `verdict`."""
import os
import random
import select
import tempfile
import time

import serial_rig as rig
from faults import kinds, process
from faults.emulator import PORTS, Emulator, VehicleDaemon
from faults.line import Line
from faults.watcher import Watcher

NS = rig.NS
RETURN_LIMIT_S = 60
LEAK_PATIENCE_S = 5
QUIET_S = (0.5, 1.1)


class Fault:
    """One fault at one line: what the generators of `kinds` are given, and what became of it."""

    def __init__(self, campaign, kind, line, rng):
        self.kind, self.line, self.rng, self.emulator = kind, line, rng, campaign.emulator
        self.begin_ns = time.monotonic_ns()
        self.cut_ns = self.end_ns = self.back_ns = None
        self.life = self.offset = None  # where the undisturbed bytes begin again
        self.descriptors = self.anonymous_KiB = None

    def when_cut(self):
        self.cut_ns = time.monotonic_ns()


class Campaign:
    def __init__(self, seed, environment=lambda folder: None):
        """`environment(folder)`: what navcald is started with besides."""
        self.rng = random.Random(seed)
        self.folder = tempfile.mkdtemp(prefix="navcal-reliability-")
        self.daemon, self.faults = None, []
        self.emulator = Emulator(self.folder, seed)
        try:
            self.start(environment(self.folder))
        except BaseException:
            self.__exit__()
            raise

    def start(self, environment):
        self.lines = [Line(name, *settings, self.emulator.link(name), self.folder) for name, settings in PORTS.items()]
        self.daemon = VehicleDaemon("navcald", [], folder=self.folder, environment=environment)
        self.watcher = Watcher(self.daemon.connect())
        self.poll = select.poll()
        for line in self.lines:
            self.poll.register(line.device, select.POLLIN)
        self.poll.register(self.watcher.sock, select.POLLIN)

    def pump_until(self, end_ns, done=lambda: False):
        while (left_ns := end_ns - time.monotonic_ns()) > 0 and not done():
            self.poll.poll(min(10, left_ns // 1_000_000))
            for line in self.lines:
                line.from_device()
                line.from_daemon()
            self.watcher.pump()
            if self.daemon.process.poll() is not None:
                raise SystemExit(f"navcald ended with {self.daemon.process.returncode}: see {self.daemon.errors.name}")
            if left_ns < 1_000_000:
                time.sleep(left_ns / NS)

    def pump(self, seconds, done=lambda: False):
        self.pump_until(time.monotonic_ns() + int(seconds * NS), done)

    def heard_since(self, time_ns, device):
        heard = self.watcher.heard.get(device, [])
        return bool(heard) and heard[-1] > time_ns

    def descriptors(self):
        return process.descriptors(self.daemon.process.pid)

    def fewest_descriptors(self):
        counts = []
        for _ in range(20):
            counts.append(self.descriptors())
            self.pump(0.02)
        return min(counts)

    def settle(self):
        """Until every device is heard; the compass and the receiver have their dialogues first."""
        begin_ns = time.monotonic_ns()
        self.pump(RETURN_LIMIT_S, lambda: all(self.heard_since(begin_ns, name) for name in PORTS))
        self.pump(3)
        silent = [name for name in PORTS if not self.heard_since(begin_ns, name)]
        if silent:
            raise SystemExit(f"never heard: {silent}; see {self.daemon.errors.name}")

    def strike(self, kind, line):
        fault = Fault(self, kind, line, self.rng)
        for seconds in kinds.KINDS[kind](fault):
            self.pump(seconds)
        self.recover(fault)

    def recover(self, fault):
        fault.end_ns = time.monotonic_ns()
        fault.life, fault.offset = len(fault.line.lives) - 1, len(fault.line.lives[-1].data)
        self.pump(RETURN_LIMIT_S, lambda: self.heard_since(fault.end_ns, fault.line.name))
        # A second one: the first may have been under way when the fault ended.
        self.pump(3, lambda: len(self.watcher.heard[fault.line.name]) > 1
                  and self.watcher.heard[fault.line.name][-2] > fault.end_ns)
        fault.back_ns = time.monotonic_ns()
        self.pump(self.rng.uniform(*QUIET_S))
        # One that is open for a moment, as while the state of the calibrators is saved, is no leak.
        self.pump(LEAK_PATIENCE_S, lambda: self.descriptors() == self.first_descriptors)
        fault.descriptors = self.descriptors()
        fault.anonymous_KiB = process.anonymous_KiB(self.daemon.process.pid)
        self.faults.append(fault)

    def next_case(self):
        kind = self.rng.choice(list(kinds.KINDS))
        names = kinds.ONLY_AT.get(kind, tuple(PORTS))
        name = self.rng.choice(names)
        return kind, next(line for line in self.lines if line.name == name)

    def run(self, seconds, say=None):
        self.settle()
        self.began_ns = time.monotonic_ns()
        self.first_descriptors = self.fewest_descriptors()
        end_ns = self.began_ns + int(seconds * NS)
        while time.monotonic_ns() < end_ns:
            self.strike(*self.next_case())
            if say:
                say(self)
        self.ended_ns = time.monotonic_ns()

    def finish(self):
        """Stops the daemon; the log is complete afterwards."""
        self.pump(1)
        self.daemon.process.terminate()
        self.status = self.daemon.process.wait(30)
        for line in self.lines:
            line.lives[-1].ended_ns = time.monotonic_ns()
            os.close(line.pty.master)
            os.close(line.device)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.daemon and self.daemon.process.poll() is None:
            self.daemon.process.kill()
            self.daemon.process.wait()
        self.emulator.stop()
