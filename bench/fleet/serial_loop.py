# SPDX-License-Identifier: Apache-2.0
"""Processor time of navcal fleet against a loop of navcal over the same recordings.

usage: serial_loop.py NAVCAL [--recordings N] [--seconds S] [--job calibrate|gap] [--jobs N] [--bank N]

One recording is poisoned. The loop runs `navcal calibrate --json` or `navcal gap --json -` for each recording, with one
cache of null banks; the fleet is plan, submit --local and merge. Prints user and system time of both, and their ratio.
"""

import argparse
import pathlib
import resource
import shutil
import subprocess
import tempfile
import time


def cpu_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def timed(work):
    before, began = cpu_s(), time.monotonic()
    work()
    return cpu_s() - before, time.monotonic() - began


def variants(source, folder, count):
    """Recordings of different content: the one that was simulated, each with another mark at its head."""
    text = source.read_text()
    head, rest = text.split("\n", 1)
    folder.mkdir()
    for i in range(count - 1):
        (folder / f"{i:05}.cap").write_text(f"{head}\n# recording {i}\n{rest}")
    (folder / "poison.cap").write_text("#capture 1\npoison\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("navcal", type=lambda name: str(pathlib.Path(name).resolve()))
    parser.add_argument("--recordings", type=int, default=1000)
    parser.add_argument("--seconds", type=int, default=60, help="length of a recording")
    parser.add_argument("--job", choices=["calibrate", "gap"], default="calibrate")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--bank", type=int, default=20)
    wanted = parser.parse_args()
    folder = pathlib.Path(tempfile.mkdtemp(prefix="navcal-fleet-"))
    recordings, plan = folder / "recordings", folder / "plan"
    whole = folder / "whole.cap"
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    subprocess.run([wanted.navcal, "simulate", "--mission", "identification", "-o", whole], check=True, **quiet)
    short = folder / "short.cap"
    lines, begin = [], None
    for line in whole.read_text().splitlines():
        if line[0].isdigit():
            stamp = float(line.split(" ", 1)[0])
            begin = begin or stamp
            if stamp > begin + wanted.seconds:
                break
        lines.append(line)
    short.write_text("\n".join(lines) + "\n")
    variants(short, recordings, wanted.recordings)
    cache = folder / "cache"

    def loop():
        for file in sorted(recordings.iterdir()):
            if wanted.job == "calibrate":
                command = [wanted.navcal, "calibrate", "--json", file]
            else:
                command = [wanted.navcal, "gap", "--json", "-", "--bank", str(wanted.bank), "--cache", cache, file]
            subprocess.run(command, **quiet)

    def fleet():
        for words in (
            ["plan", recordings, "-o", plan, "--job", wanted.job, "--bank", str(wanted.bank)],
            ["submit", plan, "--local", "--jobs", str(wanted.jobs)],
            ["merge", plan],
        ):
            subprocess.run([wanted.navcal, "fleet", *words], check=True, **quiet)

    loop_cpu, loop_s = timed(loop)
    fleet_cpu, fleet_s = timed(fleet)
    listed = subprocess.run([wanted.navcal, "fleet", "list", "--json", plan], check=True, capture_output=True, text=True)
    states = [line.split('"state":"', 1)[1].split('"', 1)[0] for line in listed.stdout.splitlines()]
    print(f"{wanted.recordings} recordings of {wanted.seconds} s, {wanted.job}: "
          f"{', '.join(f'{states.count(state)} {state}' for state in ('done', 'failed', 'open'))}")
    print(f"loop:  {loop_cpu:8.2f} s of processor time, {loop_s:8.2f} s")
    print(f"fleet: {fleet_cpu:8.2f} s of processor time, {fleet_s:8.2f} s ({wanted.jobs} jobs)")
    print(f"ratio of processor times: {fleet_cpu / loop_cpu:.3f}")
    shutil.rmtree(folder)


if __name__ == "__main__":
    main()
