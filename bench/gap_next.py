#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What one planned mission adds to a survey, against as many minutes more of survey, on the simulator's own missions.

    python3 bench/gap_next.py NAVCAL [--strength 0.2] [--cases 12] [--minutes 3] [--seed 1]

A case is one effect, in turn from the library, in a direction of its own. The vehicle sails a survey of three minutes. navcal
gap next plans a mission, the vehicle sails it, and both recordings are diagnosed together. The control has another survey of
the same length in the place of the planned mission. Printed for each case: what was named, and for the set that is true the
change of its log odds against the strongest rival that was expected and that came. The program under test makes
recordings and answers, so this measures the planning alone; the reference simulator judges the answers (docs/trial.md).
"""
import argparse
import json
import math
import pathlib
import random
import re
import subprocess
import tempfile


# They act on the lines to the host and are no causes.
OF_LINES = {"arrival_jitter", "clock_error", "dropped_frames", "gyro_random_walk", "noise_level", "repeated_frames", "stalls"}


def effects_of(navcal):
    """Names of the library with their parameters and typical values."""
    lines = subprocess.run([navcal, "simulate", "--list-effects"], capture_output=True, text=True, check=True).stdout
    effects = {}
    for line in lines.splitlines():
        cells = re.split(r" \| ", line.strip().strip("|").strip())
        if len(cells) != 4 or not re.match(r"\d", cells[3]):
            continue
        name, _, parameters, typical = cells
        value = float(re.match(r"[-+.\de]+", typical).group())
        if name not in OF_LINES:
            effects[name] = {parameter: value for parameter in parameters.split()}
    return effects


# Parameters that cannot be negative.
POSITIVE = {"compass_lag", "fin_backlash", "fin_lag", "imu_latency", "gps_latency", "tilt_slosh"}


def within_tolerance(dice, name, parameters):
    """Values of an effect's parameters on a vehicle without a gap: normal, 2 % of the typical value."""
    values = {each: dice.gauss(0, 0.02) * typical for each, typical in parameters.items()}
    return {each: abs(value) for each, value in values.items()} if name in POSITIVE else values


def navcal_json(command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip())
    return json.loads(done.stdout)


def named(answer):
    return sorted(effect["name"] for effect in answer["effects"])


def verdict_of(answer, truth):
    names = named(answer)
    return "exact" if names == [truth] else "wrong" if names else answer["verdict"]


class Case:
    def __init__(self, arguments, folder, name, parameters, number):
        self.arguments, self.folder, self.name, self.number = arguments, folder, name, number
        dice = random.Random(f"{arguments.seed} {number}")
        raw = {key: dice.gauss(0, 1) for key in parameters}
        norm = math.sqrt(sum(value * value for value in raw.values()))
        lag = name.endswith("lag") or name.endswith("latency") or name in ("fin_backlash", "magnetic_hysteresis")
        self.effects = folder / f"{number}.toml"
        text = f"[{name}]\n"
        for key, typical in parameters.items():
            value = arguments.strength * typical * raw[key] / norm
            text += f"{key} = {abs(value) if lag else value}\n"
        self.effects.write_text(text)

    def sail(self, mission, seed):
        file = self.folder / f"{self.number}-{seed}.cap"
        subprocess.run([self.arguments.navcal, "simulate", "--mission", mission, "--seconds",
                        str(int(60 * self.arguments.minutes)), "--effects", self.effects, "--seed",
                        str(1000 * self.arguments.seed + 10 * self.number + seed), "-o", file], check=True,
                       capture_output=True)
        return file

    def gap(self, *files):
        return navcal_json([self.arguments.navcal, "gap", *files, "--holdout", self.holdout, "--bank",
                            str(self.arguments.bank), "--cache", self.folder / "banks", "--json", "-"])

    def run(self):
        a, self.holdout = self.sail("survey", 1), self.sail("survey", 2)
        before = self.gap(a)
        mission = self.folder / f"{self.number}-next.toml"
        plan = navcal_json([self.arguments.navcal, "gap", "next", a, "--holdout", self.holdout, "--bank",
                            str(self.arguments.bank), "--cache", self.folder / "banks", "--minutes",
                            str(self.arguments.minutes), "--mission-out", mission, "--json", "-"])
        planned = self.gap(a, self.sail(f"{mission}", 3))
        control = self.gap(a, self.sail("survey", 4))
        return {"effect": self.name, "before": verdict_of(before, self.name), "purpose": plan["purpose"],
                "predicted": plan["probability_exact"], "planned": verdict_of(planned, self.name),
                "control": verdict_of(control, self.name), "seconds": plan["seconds"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("navcal")
    parser.add_argument("--strength", type=float, default=0.2)
    parser.add_argument("--cases", type=int, default=12)
    parser.add_argument("--minutes", type=float, default=3)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--bank", type=int, default=60)
    arguments = parser.parse_args()
    library = effects_of(arguments.navcal)
    names = sorted(library)
    random.Random(arguments.seed).shuffle(names)
    counts = {"before": {}, "planned": {}, "control": {}}
    with tempfile.TemporaryDirectory() as folder:
        for number in range(arguments.cases):
            name = names[number % len(names)]
            case = Case(arguments, pathlib.Path(folder), name, library[name], number).run()
            print(json.dumps(case), flush=True)
            for when, outcomes in counts.items():
                outcomes[case[when]] = outcomes.get(case[when], 0) + 1
    for when, outcomes in counts.items():
        print(when, ", ".join(f"{outcome} {count}" for outcome, count in sorted(outcomes.items())))


if __name__ == "__main__":
    main()
