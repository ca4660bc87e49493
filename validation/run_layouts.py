#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Diagnoses the recordings that `navcal gap layouts record` made, case by case.

    python3 validation/run_layouts.py NAVCAL RECORDINGS ANSWERS.jsonl [--jobs N] [--cases 1-16]

Each vehicle is identified from its nominal recordings first; the identified layout with its standard errors is the
nominal model of its cases. An answer is one line of JSON with the key `case`. The truth is not read. Score the answers
with `navcal gap layouts score ANSWERS.jsonl --truth TRUTH.jsonl`.
"""
import argparse
import concurrent.futures
import json
import pathlib
import resource
import subprocess
import sys
import time


def run(command, limit_s):
    """Standard output of a command, or the reason why there is none."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit_s)
    except subprocess.TimeoutExpired:
        return None, f"no answer within {limit_s} s"
    if done.returncode != 0:
        return None, done.stderr.strip().splitlines()[-1] if done.stderr.strip() else f"status {done.returncode}"
    return done.stdout, ""


def identify(navcal, folder, vehicle):
    """Layout of a vehicle as its nominal recordings show it; None when that fails, with the reason."""
    identified = folder / f"vehicle-{vehicle}-identified.toml"
    if identified.exists():
        return identified, ""
    nominal = sorted(folder.glob(f"vehicle-{vehicle}-nominal-*.cap"))
    _, why = run([navcal, "identify", "--vehicle", folder / f"vehicle-{vehicle}.toml", "--config",
                  folder / "navcald.toml", *nominal[:-1], "--holdout", nominal[-1], "-o", identified], 1800)
    return (identified, "") if not why else (None, why)


def diagnose(navcal, folder, case, layout, limit_s):
    name = case["case"]
    command = [navcal, "gap", "--vehicle", layout, "--config", folder / "navcald.toml"]
    for file in sorted(folder.glob(f"vehicle-{case['vehicle']}-nominal-*.cap")):
        command += ["--nominal", file]
    for letter in "bc":
        command += ["--holdout", folder / f"{name}-{letter}.cap"]
    if case.get("exclude"):
        command += ["--exclude", case["exclude"]]
    began = time.monotonic()
    output, why = run([*command, "--json", "-", folder / f"{name}-a.cap"], limit_s)
    answer = {"case": name} | (json.loads(output) if output else {"failure": why})
    print(f"{name}: {answer.get('verdict', why)} "
          f"{[(e['name'], e.get('of', '')) for e in answer.get('effects', [])]} {time.monotonic() - began:.0f} s",
          file=sys.stderr, flush=True)
    return answer


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("navcal")
    parser.add_argument("recordings", type=pathlib.Path)
    parser.add_argument("answers", type=pathlib.Path)
    parser.add_argument("--jobs", type=int, default=1, help="cases at a time")
    parser.add_argument("--limit", type=int, default=600, help="seconds for one case")
    parser.add_argument("--cases", help="names of cases, with commas; default: all")
    arguments = parser.parse_args()
    folder = arguments.recordings
    cases = [json.loads(line) for line in (folder / "cases.jsonl").read_text().splitlines()]
    if arguments.cases:
        cases = [case for case in cases if case["case"] in arguments.cases.split(",")]
    vehicles = sorted({case["vehicle"] for case in cases})
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        layouts = dict(zip(vehicles, pool.map(lambda v: identify(arguments.navcal, folder, v), vehicles)))
        for vehicle, (layout, why) in layouts.items():
            print(f"vehicle {vehicle}: {layout or why}", file=sys.stderr, flush=True)

        def answer(case):
            layout, why = layouts[case["vehicle"]]
            if layout is None:
                return {"case": case["case"], "failure": f"identify: {why}"}
            return diagnose(arguments.navcal, folder, case, layout, arguments.limit)

        answers = list(pool.map(answer, cases))
    arguments.answers.write_text("".join(json.dumps(each) + "\n" for each in answers))
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"{len(answers)} answers, {(used.ru_utime + used.ru_stime) / max(1, len(answers)):.0f} s of processor time "
          f"for each", file=sys.stderr)


if __name__ == "__main__":
    main()
