#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How often navcal gap sees a gap where there is none: on each shipped mission, by both simulators.

    python3 bench/gap_nulls.py BUILD [--each 18] [--bank 100] [--seed 1] [--missions LIST] [--minutes M] [--csv FILE]

BUILD is a build folder with the benchmarks (build/bench). A null is a vehicle of which each parameter is within tolerance
(2 % of its typical value, normal). The first simulator is the program's own; the second one is independent (docs/trial.md). Each null gets a line of
the CSV: mission, simulator, number, verdict, what is named, the smallest p-value of the residual map, the largest probability
of a candidate, and the noise power. At the end the rate of false alarms is printed as a function of each threshold, with its
95 % interval (Wilson). --minutes ends the run after so many minutes; what was judged until then is printed. The program
makes null missions of its own for each mission, from its own seed. 18 of each take about forty minutes on two cores.
"""
import argparse
import csv
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile
import time

import gap_next

MISSIONS = ["thesis1", "thesis2", "thesis3", "thesis4", "thesis5", "thesis6", "thesis7", "thesis8", "identification", "survey",
            "calibration_swing"]
COLUMNS = ["mission", "simulator", "number", "verdict", "named", "least_p_value", "candidate", "power", "floor"]


def tolerances(dice, effects):
    lines = []
    for name, parameters in effects.items():
        lines.append(f"[{name}]")
        lines += [f"{each} = {value:.9g}" for each, value in gap_next.within_tolerance(dice, name, parameters).items()]
    return "\n".join(lines) + "\n"


def own_recordings(navcal, effects, mission, seed, count, folder):
    for number in range(1, count + 1):
        dice = random.Random(f"{seed} {mission} {number}")
        toml = folder / f"own-{number}.effects.toml"
        toml.write_text(tolerances(dice, effects))
        file = folder / f"own-{number}.cap"
        subprocess.run([navcal, "simulate", "--mission", mission, "--effects", toml, "--seed", str(dice.randrange(1, 1 << 31)),
                        "-o", file], check=True, capture_output=True)
        yield number, file, []


def second_recordings(program, mission, seed, count, folder):
    done = subprocess.run([program, mission, str(seed), str(count), folder], check=True, capture_output=True, text=True)
    for number in done.stdout.split():
        yield int(number), folder / f"{number}.cap", ["--vehicle", folder / f"{number}.toml"]


def judged(navcal, bank, cache, file, options):
    done = subprocess.run([navcal, "gap", "--bank", str(bank), "--cache", cache, "--json", "-", *options, file],
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip())
    answer = json.loads(done.stdout)
    return {"verdict": answer["verdict"], "named": "+".join(effect["name"] for effect in answer["effects"]),
            "least_p_value": answer["least_p_value"],
            "candidate": max((each["probability"] for each in answer["candidates"]), default=0),
            "power": answer["gap"]["before"], "floor": answer["gap"]["floor"]}


def wilson(hits, cases):
    if cases == 0:
        return 0, 1
    z, share = 1.96, hits / cases
    middle = (share + z * z / (2 * cases)) / (1 + z * z / cases)
    half = z / (1 + z * z / cases) * math.sqrt(share * (1 - share) / cases + z * z / (4 * cases * cases))
    return max(0, middle - half), min(1, middle + half)


def share_text(hits, cases):
    low, high = wilson(hits, cases)
    return f"{hits:4} of {cases:4}  {100 * hits / max(cases, 1):5.1f} %  ({100 * low:.1f} to {100 * high:.1f} %)"


def print_rates(rows):
    print("\nfalse alarms (a verdict other than no-gap; in brackets the 95 % interval)")
    for simulator in ["own", "second"]:
        for mission in MISSIONS:
            some = [row for row in rows if row["simulator"] == simulator and row["mission"] == mission]
            if some:
                print(f"  {simulator:7} {mission:18} {share_text(sum(row['verdict'] != 'no-gap' for row in some), len(some))}")
        some = [row for row in rows if row["simulator"] == simulator]
        print(f"  {simulator:7} {'all':18} {share_text(sum(row['verdict'] != 'no-gap' for row in some), len(some))}")
    print(f"  {'both':7} {'all':18} {share_text(sum(row['verdict'] != 'no-gap' for row in rows), len(rows))}")
    print(f"  {'both':7} {'an effect named':18} {share_text(sum(bool(row['named']) for row in rows), len(rows))}")
    print("\nnulls with a smallest p-value of the residual map below a threshold")
    for threshold in [0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4, 1e-4]:
        hits = sum(row["least_p_value"] is not None and row["least_p_value"] < threshold for row in rows)
        print(f"  {threshold:7.0e} {share_text(hits, len(rows))}")
    print("\nnulls with a candidate at least as probable as a threshold")
    for threshold in [0.1, 0.3, 0.5, 0.7, 0.9, 0.99]:
        print(f"  {threshold:7} {share_text(sum(row['candidate'] >= threshold for row in rows), len(rows))}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--each", type=int, default=18)
    parser.add_argument("--bank", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--missions", default=",".join(MISSIONS))
    parser.add_argument("--minutes", type=float)
    parser.add_argument("--csv", type=pathlib.Path)
    arguments = parser.parse_args()
    navcal, second = arguments.build / "cli/navcal", arguments.build / "bench/bench_null_recordings"
    effects = gap_next.effects_of(navcal)
    until = time.monotonic() + 60 * arguments.minutes if arguments.minutes else math.inf
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for mission in arguments.missions.split(","):
            own = own_recordings(navcal, effects, mission, arguments.seed, arguments.each, folder)
            for simulator, recordings in [("own", own),
                                          ("second", second_recordings(second, mission, arguments.seed, arguments.each, folder))]:
                for number, file, options in recordings:
                    if time.monotonic() > until:
                        continue
                    answer = judged(navcal, arguments.bank, folder / "banks", file, options)
                    rows.append({"mission": mission, "simulator": simulator, "number": number, **answer})
                    file.unlink()
                    print(f"\r{len(rows)} nulls, {sum(row['verdict'] != 'no-gap' for row in rows)} alarms, {mission}   ",
                          end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    if arguments.csv:
        with arguments.csv.open("w", newline="") as out:
            out.write(f"# python3 bench/gap_nulls.py {arguments.build} --each {arguments.each} --bank {arguments.bank} --seed {arguments.seed}\n")
            writer = csv.DictWriter(out, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
    print_rates(rows)


if __name__ == "__main__":
    main()
