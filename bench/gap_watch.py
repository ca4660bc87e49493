#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""False alarms of navcal gap watch, and how soon and how rightly it tells of a change.

    python3 bench/gap_watch.py NAVCAL [--nulls 20] [--changes 20] [--minutes 30] [--strength 0.5] [--seed 1] [--jobs 2]

Each recording is a mission of the reference vehicle with every parameter within tolerance (2 % of its typical value, normal)
and a current that is there for part of the mission only. A null has nothing else: each alarm in it is false. A change has one
effect of the library at this strength, in a direction of its own, from a third of the mission on; an alarm before that is false.
Printed for each recording: mission, effect, alarm, delay, the name at the end. The program under test simulates and watches,
so this measures the watch alone, not how well the simulator describes a vehicle.
"""
import argparse
import concurrent.futures
import json
import pathlib
import random
import subprocess
import tempfile

import gap_next

MISSIONS = ["survey", "identification", "thesis1", "thesis2", "thesis3", "thesis4", "thesis5", "thesis6", "thesis7", "thesis8"]
BEGIN_S = 1767225600  # of a simulated recording without --date
# Not watched for: they build up over minutes, or change from day to day.
UNWATCHED = {"water_current", "gyro_drift", "gyro_random_walk", "magnetic_hysteresis"}


def direction(dice, parameters, positive):
    values = {name: dice.gauss(0, 1) for name in parameters}
    norm = sum(value * value for value in values.values()) ** 0.5
    return {name: (abs(value) if positive else value) / norm for name, value in values.items()}


def effects_toml(dice, effects, cause, strength, seconds):
    lines = []
    for name, parameters in effects.items():
        if name in UNWATCHED:
            continue
        values = gap_next.within_tolerance(dice, name, parameters)
        if name == cause:
            shares = direction(dice, parameters, name in gap_next.POSITIVE)
            values = {each: strength * shares[each] * typical for each, typical in parameters.items()}
            lines += [f"[{name}]", f"from_s = {seconds / 3}"]
        else:
            lines += [f"[{name}]"]
        lines += [f"{each} = {value:.9g}" for each, value in values.items()]
    north, east = dice.gauss(0, 0.15), dice.gauss(0, 0.15)
    lines += ["[water_current]", f"from_s = {seconds * dice.random()}", f"north_m_s = {north:.6g}", f"east_m_s = {east:.6g}"]
    return "\n".join(lines) + "\n"


def watched(arguments, effects, folder, number, cause):
    dice = random.Random(f"{arguments.seed} {number} {cause}")
    mission = dice.choice(MISSIONS)
    seconds = 60 * arguments.minutes
    file, recording = folder / f"{number}.toml", folder / f"{number}.cap"
    file.write_text(effects_toml(dice, effects, cause, arguments.strength, seconds))
    subprocess.run([arguments.navcal, "simulate", "--mission", mission, "--seconds", str(seconds), "--effects", str(file),
                    "--seed", str(arguments.seed * 1000 + number), "-o", str(recording)], check=True, capture_output=True)
    done = subprocess.run([arguments.navcal, "gap", "watch", "--recording", str(recording), "--cache", str(folder / "cache")],
                          capture_output=True, text=True, check=True)
    recording.unlink()
    events = [json.loads(line) for line in done.stdout.splitlines()]
    last = events[-1]
    alarm = last.get("alarm")
    named = [event for event in events if event["event"] == "cause"]
    return {"mission": mission, "cause": cause, "windows": last["windows"], "skipped": last["skipped"],
            "alarm_s": None if alarm is None else alarm - BEGIN_S, "verdict": last["verdict"],
            "first": last["effects"][0]["name"] if alarm else None,
            "named_s": named[0]["time"] - BEGIN_S if named else None,
            "where": last["where"][0]["channel"] if alarm and last["where"] else None,
            "evidence": last["evidence_nats"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("navcal")
    parser.add_argument("--nulls", type=int, default=20)
    parser.add_argument("--changes", type=int, default=20)
    parser.add_argument("--minutes", type=float, default=30)
    parser.add_argument("--strength", type=float, default=0.5)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    effects = gap_next.effects_of(arguments.navcal)
    causes = sorted(set(effects) - UNWATCHED)
    jobs = [(number, None) for number in range(arguments.nulls)]
    jobs += [(arguments.nulls + number, causes[(number * 7 + arguments.seed) % len(causes)]) for number in range(arguments.changes)]
    results = []
    with tempfile.TemporaryDirectory() as name, concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        folder = pathlib.Path(name)
        watched(arguments, effects, folder, 999_999, None)  # makes the null bank
        for result in pool.map(lambda job: watched(arguments, effects, folder, *job), jobs):
            results.append(result)
            print(json.dumps(result), flush=True)
    nulls = [each for each in results if each["cause"] is None]
    changes = [each for each in results if each["cause"] is not None]
    onset_s = 60 * arguments.minutes / 3
    hours = sum(each["windows"] for each in nulls) * 30 / 3600
    early = [each for each in changes if each["alarm_s"] is not None and each["alarm_s"] <= onset_s]
    late = [each for each in changes if each["alarm_s"] is not None and each["alarm_s"] > onset_s]
    false = [each for each in nulls if each["alarm_s"] is not None]
    named = [each for each in late if each["verdict"] == "named"]
    right = [each for each in named if each["first"] == each["cause"]]
    delays = sorted(each["alarm_s"] - onset_s for each in late)
    print(f"false alarms: {len(false)} in {hours:.1f} h without a change, {len(early)} before a change")
    print(f"changes seen: {len(late)} of {len(changes)}; median delay "
          f"{delays[len(delays) // 2] if delays else float('nan'):.0f} s")
    print(f"named at the end: {len(named)}, of them right {len(right)}; "
          f"leading cause right in {sum(each['first'] == each['cause'] for each in late)} of {len(late)}")


if __name__ == "__main__":
    main()
