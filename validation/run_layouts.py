#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Diagnoses the recordings that `navcal gap layouts record` wrote, as a user would: each vehicle is identified from its
nominal recordings, then each of its cases is diagnosed.

usage: run_layouts.py NAVCAL FOLDER ANSWERS.jsonl [--layout-error F] [--cases FIRST:LAST]

The layout's file becomes a data sheet with standard errors, those of --layout-error (docs/trial.md). Answers are
appended one by one; cases that have one are left out, so that a run that was ended can be continued. The truth is never read:
navcal gap layouts score ANSWERS.jsonl --truth TRUTH.jsonl
"""

import argparse
import json
import math
import pathlib
import re
import resource
import subprocess
import tomllib


def data_sheet(text, error):
    """The layout's text with standard errors for vehicles that are off it by `error`."""
    layout = tomllib.loads(text)
    body = layout["body"]
    centres = [body.get(key, [0, 0, 0]) for key in ("gravity_centre_m", "buoyancy_centre_m")]
    arm_m = math.dist(*centres)
    parts = {"mass_kg": error / 4, "inertia_kg_m2": error, "matrix": 2 * error, "linear": 2 * error,
             "quadratic": 2 * error, "coefficient": 2 * error, "lag_s": 2 * error}
    lines = []
    for line in text.splitlines():
        key, _, value = (part.strip() for part in line.partition("="))
        if re.fullmatch(r"\w+_(std|range)", key):
            continue
        lines.append(line)
        if key in parts:
            number = tomllib.loads(line)[key]
            std = [abs(x) * parts[key] for x in number] if isinstance(number, list) else number * parts[key]
            lines.append(f"{key}_std = {std}")
        elif key == "gravity_centre_m":
            lines.append(f"{key}_std = {[arm_m * error] * 3}")
        elif line.strip() == "[[thruster]]":
            lines += ["force_scale = 1", f"force_scale_std = {error}"]
    return "\n".join(lines) + "\n"


def run(command):
    """Text of standard output, and processor seconds. Raises RuntimeError with the program's last line."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    if done.returncode != 0:
        raise RuntimeError((done.stderr.strip().splitlines() or ["no words"])[-1])
    return done.stdout, seconds


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("navcal", type=pathlib.Path)
    arguments.add_argument("folder", type=pathlib.Path)
    arguments.add_argument("answers", type=pathlib.Path)
    arguments.add_argument("--layout-error", type=float, default=0.05)
    arguments.add_argument("--cases", default="1:9999")
    given = arguments.parse_args()
    first, last = (int(part) for part in given.cases.split(":"))
    configuration = ["--config", given.folder / "navcald.toml"]
    answered = set()
    if given.answers.exists():
        answered = {json.loads(line)["case"] for line in given.answers.read_text().splitlines()}
    for line in (given.folder / "cases.jsonl").read_text().splitlines():
        case = json.loads(line)
        if case["case"] in answered or not first <= int(case["case"]) <= last:
            continue
        name = f"vehicle-{case['vehicle']}"
        nominals = sorted(given.folder.glob(f"{name}-nominal-*.cap"))
        vehicle = given.answers.with_name(f"{given.answers.stem}-{name}.toml")
        answer = {"case": case["case"]}
        try:
            if not vehicle.exists():
                sheet = vehicle.with_name(f"{vehicle.stem}-sheet.toml")
                sheet.write_text(data_sheet((given.folder / f"{name}.toml").read_text(), given.layout_error))
                run([given.navcal, "identify", "--no-advice", *configuration, "--vehicle", sheet, "-o", vehicle, *nominals])
            command = [given.navcal, "gap", *configuration, "--vehicle", vehicle, "--json", "-"]
            for nominal in nominals:
                command += ["--nominal", nominal]
            for letter in "bc":
                command += ["--holdout", given.folder / f"{case['case']}-{letter}.cap"]
            if case["exclude"]:
                command += ["--exclude", case["exclude"]]
            text, seconds = run([*command, given.folder / f"{case['case']}-a.cap"])
            answer.update(json.loads(text))
            answer["processor_seconds"] = seconds
        except RuntimeError as failure:
            answer["failure"] = str(failure)
        with given.answers.open("a") as out:
            out.write(json.dumps(answer) + "\n")
        print(case["case"], answer.get("sentence", answer.get("failure")), flush=True)


if __name__ == "__main__":
    main()
