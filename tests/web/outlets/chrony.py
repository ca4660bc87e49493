# SPDX-License-Identifier: Apache-2.0
"""A real chronyd, which may not set the clock, takes navcald's UTC from navcal-web by its refclock SOCK.

usage: chrony.py NAVCAL_WEB SOURCE_FOLDER
"""
import os
import subprocess
import sys
import time

from stand import SKIPPED, Stand, clock, get, need, wait_for

program, _ = sys.argv[1:3]
need("chronyd", "chronyc")
if os.geteuid() != 0:
    print("skipped: chronyd wants root")
    sys.exit(SKIPPED)
AHEAD_S = 0.125  # of the true time, by this test, from the clock of this machine

with Stand() as stand:
    path = os.path.join(stand.folder, "navcal.sock")
    command = os.path.join(stand.folder, "command", "chronyd.sock")
    os.mkdir(os.path.dirname(command), 0o750)
    config = os.path.join(stand.folder, "chrony.conf")
    with open(config, "w", encoding="ascii") as file:
        file.write(f"refclock SOCK {path} refid NAVC poll 0 filter 1 precision 1e-3 delay 0.04\ncmdport 0\nport 0\n"
                   f"bindcmdaddress {command}\npidfile {stand.folder}/chronyd.pid\n")
    # -x: the clock of this machine is not touched; -d: in the foreground.
    stand.start("chronyd", "-x", "-d", "-u", "root", "-f", config, env={**os.environ, "PATH": os.environ["PATH"] + ":/usr/sbin"})
    wait_for("chronyd's socket", lambda: os.path.exists(path))

    def ask(what):
        done = subprocess.run(["chronyc", "-c", "-h", command, what], text=True, capture_output=True, check=False)
        rows = [line.split(",") for line in done.stdout.splitlines()]
        return next((row for row in rows if "NAVC" in row), None)

    def samples():
        for line in get(address + "/metrics")[1].splitlines():
            if line.startswith("navcal_web_chrony_samples_total "):
                return float(line.split()[1])
        return 0

    navcald = stand.navcald()
    address = stand.web(program, navcald, "--chrony", path)
    wait_for("navcal-web watches", lambda: navcald.watching)

    def true_clock(**changes):
        message = clock(**changes)
        message["offset"] += AHEAD_S
        return message

    for wrong in ({"source": "system-synchronised"}, {"source": "none"}, {"at": time.clock_gettime(time.CLOCK_MONOTONIC) - 60},
                  {"at": time.clock_gettime(time.CLOCK_MONOTONIC) + 1000}):
        navcald.say("/time", None, true_clock(**wrong))
    navcald.say("/time", None, true_clock())
    wait_for("the first sample", lambda: samples() == 1)
    print("neither another source's mapping nor an old one is handed on")

    navcald.every(0.5, "/time", None, true_clock)
    wait_for("some samples", lambda: samples() > 8)
    # Columns of chronyc: mode (# is a reference clock), state, name, stratum, poll, reach (octal), age, offset after
    # chronyd's own corrections, offset as measured, error.
    source = wait_for("chronyd has a source it can reach", lambda: [
        row for row in [ask("sources")] if row and row[0] == "#" and int(row[5], 8) >= 7])[0]
    statistics = wait_for("statistics", lambda: [row for row in [ask("sourcestats")] if row and int(row[1]) >= 4])[0]
    measured_s = float(source[8])
    print(f"chronyd: {','.join(source)}; {','.join(statistics)}")
    # Negative: the system clock is behind. The limit is what a busy machine does between two readings of this test.
    assert abs(measured_s + AHEAD_S) < 0.01, f"offset {measured_s} s, not {-AHEAD_S} s"

    once = clock()
    navcald.sources.clear()
    time.sleep(0.2)
    before = samples()
    for _ in range(5):
        navcald.say("/time", None, once)
    wait_for("one more", lambda: samples() > before)
    time.sleep(1)
    assert samples() == before + 1, "a mapping gives one sample"
print("chronyd takes it")
