# SPDX-License-Identifier: Apache-2.0
"""Memory: navcald under valgrind, allocations a frame on the steady path, and a day of mission at accelerated pace."""
import os
import shutil
import struct
import subprocess
import tempfile
import time

import serial_rig as rig
from faults import arguments, process
from faults.emulator import PORTS, Emulator, VehicleDaemon, navcal_binary
from faults.watcher import Watcher

COUNTER = os.path.join(rig.ROOT, "build", "bench", "bench", "libcounting_heap.so")
WARM_S = 15
ERRORS = 99  # valgrind's exit status when it has found any


def add(commands):
    parser = arguments.common(commands, "memory", "valgrind, allocations a frame, a day of mission (bench build, valgrind)")
    parser.add_argument("--seconds", type=float, default=60, help="under valgrind, and of counting")
    parser.add_argument("--hours", type=float, default=24, help="of the accelerated mission")


def command(a):
    return f"bench/reliability memory --hours {a.hours:g} --seed {a.seed}"


class UnderValgrind(VehicleDaemon):
    """The same daemon as a child of valgrind's, which takes its place."""

    def start(self, command, environment):
        tool = ["valgrind", "-q", "--leak-check=full", "--errors-for-leak-kinds=definite,indirect,possible",
                f"--error-exitcode={ERRORS}"]
        super().start(tool + command, environment)


class Vehicle:
    """Emulated instruments and a daemon at them, with one client that watches."""

    def __init__(self, seed, kind=VehicleDaemon, environment=None):
        self.folder = tempfile.mkdtemp(prefix="navcal-reliability-")
        self.emulator = Emulator(self.folder, seed)
        for name in PORTS:
            os.symlink(self.emulator.link(name), os.path.join(self.folder, name))
        self.daemon = kind("navcald", [], folder=self.folder, environment=environment)
        self.watcher = Watcher(self.daemon.connect(timeout_s=60))

    def watch(self, seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.watcher.pump()
            time.sleep(0.01)

    def frames(self):
        return sum(port["frames"] for port in self.watcher.health["ports"])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.daemon.process.poll() is None:
            self.daemon.process.kill()
            self.daemon.process.wait()
        self.emulator.stop()
        shutil.rmtree(self.folder, ignore_errors=True)


def valgrind(a):
    with Vehicle(a.seed, UnderValgrind) as vehicle:
        vehicle.watch(a.seconds)
        for name in PORTS:
            vehicle.emulator.tell(f"unplug {name}")
            vehicle.watch(1)
            vehicle.emulator.tell(f"replug {name}")
        vehicle.watch(10)
        frames = vehicle.frames()
        vehicle.daemon.process.terminate()
        status = vehicle.daemon.process.wait(120)
        with open(vehicle.daemon.errors.name, errors="replace") as f:
            said = [line for line in f.read().splitlines() if line.startswith("==")]
    return {"frames": frames, "status": status, "said": said[:40]}


class Quiet(VehicleDaemon):
    """Without the reports that come by the clock: what is left is the frames' own."""

    settings = {"status.health_interval_s": "3600"}


def allocations(a, kind):
    counts = os.path.join(tempfile.mkdtemp(prefix="navcal-reliability-"), "allocations")
    with Vehicle(a.seed, kind, {"LD_PRELOAD": COUNTER, "ALLOCATIONS_FILE": counts}) as vehicle:
        def read():
            with open(counts, "rb") as f:
                return sum(struct.unpack("<3Q", f.read(24))), sum(map(len, vehicle.watcher.heard.values()))
        vehicle.watch(WARM_S)
        first, first_samples = read()
        vehicle.watch(a.seconds)
        last, last_samples = read()
    samples = last_samples - first_samples
    return {"seconds": a.seconds, "allocations": last - first, "samples": samples, "each": round((last - first) / samples, 3)}


def day(a):
    folder = tempfile.mkdtemp(prefix="navcal-reliability-")
    recording = os.path.join(folder, "day.cap")
    subprocess.run(["nice", navcal_binary(), "simulate", "--mission", "survey", "--seconds", str(a.hours * 3600),
                    "--seed", str(a.seed), "-o", recording], check=True, capture_output=True)
    size = os.path.getsize(recording)
    memory, lines, begin = [], 0, time.monotonic()
    replay = subprocess.Popen(["nice", navcal_binary(), "replay", "--json", recording], stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL)
    while block := replay.stdout.read(4 << 20):
        lines += block.count(b"\n")
        if (used := process.anonymous_KiB(replay.pid)) is not None:
            memory.append(used)
    status = replay.wait()
    shutil.rmtree(folder, ignore_errors=True)
    tenth = len(memory) // 10
    return {"hours": a.hours, "recording_MB": round(size / 1e6), "samples": lines, "status": status,
            "times_real_time": round(a.hours * 3600 / (time.monotonic() - begin)),
            "anonymous_KiB": {"after_a_tenth": memory[tenth], "at_half": memory[len(memory) // 2], "at_end": memory[-1],
                              "most": max(memory)}}


def run(a):
    if shutil.which("valgrind") is None:
        arguments.skip("there is no valgrind here")
    if not os.path.exists(COUNTER):
        arguments.skip(f"{COUNTER} is not there: cmake --preset bench && cmake --build build/bench")
    result = {"valgrind": valgrind(a), "allocations": allocations(a, VehicleDaemon),
              "frames_alone": allocations(a, Quiet), "day": day(a)}
    problems = []
    if result["valgrind"]["status"] != 0:
        problems.append(f"valgrind: status {result['valgrind']['status']}")
    if result["day"]["status"] != 0:
        problems.append(f"replay ended with {result['day']['status']}")
    return result, problems
