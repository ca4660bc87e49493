#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How long `navcal audit --report` takes for half an hour of log, and how much memory.

    python3 bench/audit_trial/seconds.py NAVCAL [--rate 100]

A simulated mission of 30 minutes with a second compass, as capture, DataFlash, ULog and telemetry log. The inertial unit has 20 readings a
second, or `--rate`: those between are interpolated, with noise.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

from sample import MISSION
from vehicles import as_autopilot, random_of, samples_of, second_compass, simulated
from writers import WRITERS, Sample

CASE = {"simulator_seed": 1, "mission": MISSION.replace("start.depth_m", 'mission.at_end = "repeat"\nstart.depth_m', 1), "vehicle": "reference",
        "place": (44.6, -63.5), "seconds": 1800}


def denser(samples, factor, dice):
    made = []
    for first, second in zip(samples, samples[1:]):
        for i in range(factor):
            share = i / factor
            between = lambda a, b: a + share * (b - a)
            values = {key: [between(a, b) + dice.gauss(0, 0.001) for a, b in zip(first.values[key], second.values[key])] for key in first.values}
            made.append(Sample(between(first.time_s, second.time_s), between(first.arrival_s, second.arrival_s), values))
    return made


# In a process of its own: one that is started begins with the memory of the process that starts it.
MEASURE = """import resource, subprocess, sys, time
begin = time.monotonic()
done = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
usage = resource.getrusage(resource.RUSAGE_CHILDREN)
if done.returncode != 0:
    sys.exit(done.stderr.decode())
print(time.monotonic() - begin, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024 / 1e6)"""


def measured(command):
    done = subprocess.run([sys.executable, "-c", MEASURE, *command], check=True, capture_output=True, text=True)
    return map(float, done.stdout.split())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("navcal")
    parser.add_argument("--rate", type=int, default=20)
    arguments = parser.parse_args()
    dice = random_of("seconds")
    print("| log | MB | readings of the inertial unit a second | seconds | of processor time | MB of memory |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        truth = simulated(arguments.navcal, pathlib.Path(__file__).resolve().parents[2], folder, CASE, "")
        log = samples_of(arguments.navcal, folder / "sim.cap")
        as_autopilot(log, truth, dice)
        second_compass(log, dice)
        log["imu"] = denser(log["imu"], arguments.rate // 20, dice)
        for form, (suffix, write) in WRITERS.items():
            file = folder / ("log" + suffix)
            write(file, log)
            wall_s, cpu_s, memory_MB = measured([arguments.navcal, "audit", "--report", folder / "page.html", file])
            print(f"| {form} | {file.stat().st_size / 1e6:.1f} | {arguments.rate} | {wall_s:.1f} | {cpu_s:.1f} | {memory_MB:.0f} |", flush=True)


if __name__ == "__main__":
    main()
