#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The table of what the diagnosis can do for which vehicle (docs/gap.md): each cell is tried with short recordings, and the
table must say what came of it.

usage: check_gap_features.py NAVCAL SOURCE [--write]; with the module in PYTHONPATH, the row of the library too
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

BEGIN, END = "<!-- table of features: begin -->", "<!-- table of features: end -->"


class Vehicle:
    """A nominal vehicle as options of the commands, and recordings of it: nominal ones, and some with one effect."""

    def __init__(self, run, name, folder, file, nominal, effect):
        self.name, self.nominal = name, nominal
        self.options = ["--vehicle", file] if file else []
        make = lambda out, seed, *more: run("simulate", *self.options, "--mission", "survey", "--seconds", "60", "--seed", str(seed), *more, "-o", out)
        stem = folder / name.replace(" ", "_").replace(",", "")
        self.recordings = [f"{stem}-{i}.cap" for i in range(3)]
        for i, recording in enumerate(self.recordings):
            make(recording, 30 + i, "--effect", effect)
        if nominal:
            self.nominals = [f"{stem}-n{i}.cap" for i in range(2)]
            for i, recording in enumerate(self.nominals):
                make(recording, 40 + i)
            for recording in self.nominals:
                self.options += ["--nominal", recording]


def features(run, folder, vehicle, python):
    a, b, c = vehicle.recordings
    of = vehicle.options
    gap = lambda *more: json.loads(run("gap", *of, *more, "--json", "-"))
    out = lambda name: str(folder / (vehicle.name.replace(" ", "_") + name))

    def export(form):
        run("gap", *of, a, "--export", f"{form}={out('.export')}")
        return os.path.getsize(out(".export")) > 0

    def planned():
        run("gap", "next", *of, a, "--minutes", "2", "--mission-out", out(".mission.toml"))
        return os.path.getsize(out(".mission.toml")) > 0

    def watched():
        return '"event":"began"' in run("gap", "watch", *of, "--recording", a, statuses=(0, 1)).replace(" ", "")

    def fleet(job):
        plan = out("." + job)
        dives = pathlib.Path(out(".dives"))
        dives.mkdir(exist_ok=True)
        for i, recording in enumerate(vehicle.recordings):
            link = dives / f"d{i}.cap"
            link.exists() or os.link(recording, link)
        run("fleet", "plan", str(dives), "-o", plan, *of, "--job", job)
        run("fleet", "submit", plan, "--local")
        if job == "gap":
            return all(json.loads(line)["state"] == "done" for line in run("fleet", "list", "--json", plan).splitlines())
        return json.loads(run("fleet", "causes", plan, "--json", "-"))["vehicles"]

    def library():
        code = (f"import navcal; print(navcal.diagnose({a!r}, vehicle={file_of(of)!r}, nominals={getattr(vehicle, 'nominals', [])!r}).json)")
        return json.loads(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)

    layout = vehicle.nominal
    yield "one recording", lambda: gap(a)["verdict"]
    yield "several recordings", lambda: len(gap(a, b)["recordings"]) == 2
    yield "`--holdout`", lambda: gap(a, "--holdout", b)["gap"]["held_out"]
    yield "`--without`", lambda: gap(a, "--without", "gps")["verdict"]
    yield "`--field`", lambda: gap(a, "--field", "18,2,44")["verdict"]
    yield "`--exclude`", lambda: gap(a, "--exclude", "gyro_scale")["verdict"]
    yield "`--export`", lambda: export("layout" if layout else "sitl")
    yield "`gap next`", planned
    yield "`gap watch`", watched
    yield "`fleet plan --job gap`", lambda: fleet("gap")
    yield "`fleet plan --job evidence`, `fleet causes`", lambda: fleet("evidence")
    if python:
        yield "library and Python", library


def file_of(options):
    return options[1] if options and options[0] == "--vehicle" else ""


def main():
    arguments = [each for each in sys.argv[1:] if each != "--write"]
    navcal, source = arguments[0], pathlib.Path(arguments[1])
    python = os.environ.get("PYTHONPATH", "")
    with tempfile.TemporaryDirectory() as folder_name:
        folder = pathlib.Path(folder_name)

        def run(*command, statuses=(0,)):
            done = subprocess.run([navcal, *command], capture_output=True, text=True, cwd=folder)
            if done.returncode not in statuses:
                raise RuntimeError(f"{' '.join(command)}: status {done.returncode}: {done.stderr.strip()[-300:]}")
            return done.stdout

        vehicles = [
            Vehicle(run, "reference vehicle", folder, "", False, "gyro_scale=2"),
            Vehicle(run, "the same, nominal recordings", folder, "", True, "gyro_scale=2"),
            Vehicle(run, "a layout, nominal recordings", folder, str(source / "share/vehicles/micro-auv.toml"), True, "gyro_scale=2"),
        ]
        rows, reasons = {}, []
        for vehicle in vehicles:
            for name, attempt in features(run, folder, vehicle, python):
                try:
                    works = bool(attempt())
                except (RuntimeError, KeyError, ValueError, OSError, subprocess.CalledProcessError) as error:
                    works = False
                    reasons.append(f"{vehicle.name}: {name}: {error} {getattr(error, 'stderr', '') or ''}")
                rows.setdefault(name, []).append("yes" if works else "no")
    table = ["| | " + " | ".join(vehicle.name for vehicle in vehicles) + " |", "|---|" + "---|" * len(vehicles)]
    table += [f"| {name} | " + " | ".join(cells) + " |" for name, cells in rows.items()]
    text = "\n".join(table)
    print(text, *reasons, sep="\n")
    docs = source / "docs/gap.md"
    content = docs.read_text()
    begin, end = content.index(BEGIN) + len(BEGIN), content.index(END)
    if "--write" in sys.argv:
        docs.write_text(content[:begin] + "\n" + text + "\n" + content[end:])
    elif content[begin:end].strip() != text:
        sys.exit("docs/gap.md says otherwise: check_gap_features.py NAVCAL SOURCE --write makes the table anew")


if __name__ == "__main__":
    main()
