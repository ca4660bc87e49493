#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Judges `navcal audit` on logs whose faults are known: 80 simulated missions, of which 20 are nominal, 40 have one fault
and 20 have two, written as capture, DataFlash, ULog and telemetry log.

    python3 bench/audit_trial NAVCAL --seed 1 --folder /tmp/trial [--jobs 2] [--cases 80]

The seed decides everything. Faults and true values are in FOLDER/cases.json before the first audit runs; its digest is
printed with the result. Logs that exist are not made again.

Rules. A fault is *right* if a finding that names it is found or likely, and its value is within 30 % of the true one or
its interval contains it; *wrong* if the value is neither; *cannot say* if that is all the audit says; *missed* if it says
nothing or that nothing was found. A finding (found or likely) that no fault of the case makes true is a *false finding*:
the answer to the case is then wrong, too. An interval *holds* if it contains the true value of the fault that it is of.
A fault is not planted where the log states nothing of it: a fault of the depth in a log without depth, for example.
"""
import argparse
import bisect
import collections
import concurrent.futures
import hashlib
import json
import math
import pathlib
import subprocess

from faults import BY_NAME, FAULTS, ITS_HEADING
from vehicles import (MISSIONS, PLACES, SECONDS, VEHICLES, as_autopilot, doppler_log, random_of, samples_of, second_compass, simulated)
from writers import WRITERS

NAMED = ("found", "likely")
NEAR = 0.3
MAP = {"dataflash": "BAT[0].Curr", "ulog": "battery_status.current_a"}


def is_possible(fault, case):
    needs = {"reference": case["vehicle"] == "reference", "dvl": case["has_dvl"], "pair": case["has_pair"],
             "declination": case["place"] in ((21.3, -157.9), (-34.1, 18.4), (-41.3, 174.8), (44.6, -63.5))}
    return case["form"] in fault.forms and all(needs[need] for need in fault.needs)


def planned(seed, number, count):
    """A case, before anything is simulated."""
    dice = random_of("audit trial", seed, number)
    faults = 0 if number < count // 4 else 1 if number < 3 * count // 4 else 2
    case = {}
    while True:
        case = {"number": number, "simulator_seed": dice.randrange(1, 10**6), "mission": dice.choice(MISSIONS),
                "vehicle": dice.choice(VEHICLES), "place": dice.choice(PLACES), "form": dice.choice(list(WRITERS)),
                "has_dvl": dice.random() < 0.3, "has_pair": dice.random() < 0.4}
        if case["vehicle"] != "reference" and case["mission"] == "identification":
            continue  # it moves fins that only the reference vehicle has
        case["has_dvl"] = case["has_dvl"] and case["form"] == "capture"
        chosen = []
        if faults:
            # Each kind in turn, so that all of them come.
            first = FAULTS[(number - count // 4) % len(FAULTS)]
            chosen = [first] + ([dice.choice(FAULTS)] if faults == 2 else [])
        if all(is_possible(fault, case) for fault in chosen) and len({fault.group for fault in chosen}) == faults:
            break
    case["faults"] = [{"name": fault.name, "size": dice.choice(fault.sizes)} for fault in chosen]
    return case


def held(log):
    """Mean age of a field at the first inertial reading after it: a telemetry log states both with the time of the latter."""
    times = sorted(sample.time_s for sample in log["imu"])
    ages = [times[i] - sample.time_s for sample in log["compass"] if (i := bisect.bisect_left(times, sample.time_s)) < len(times)]
    return sum(ages) / len(ages)


def make(navcal, repository, folder, case, seed):
    """Writes the log and the true values of a case."""
    folder.mkdir(parents=True, exist_ok=True)
    dice = random_of("made", seed, case["number"])
    effects, made = "", {}
    horizontal = None
    if any(BY_NAME[fault["name"]].effects for fault in case["faults"]):
        probe = dict(case, mission="survey")
        horizontal = math.hypot(*simulated(navcal, repository, folder, probe, "").field_ned[:2])
    for fault in case["faults"]:
        if (kind := BY_NAME[fault["name"]]).effects:
            text, made[kind.name] = kind.effects(fault["size"], dice, horizontal)
            effects += text
    truth = simulated(navcal, repository, folder, case, effects)
    planted = [fault for fault in case["faults"] if BY_NAME[fault["name"]].plant]
    suffix, write = WRITERS[case["form"]]
    log = samples_of(navcal, folder / "sim.cap")
    values = {}
    is_as_simulated = case["form"] == "capture" and not planted and not case["has_pair"] and not case["has_dvl"]
    if is_as_simulated:
        file = folder / "sim.cap"
    else:
        if case["form"] != "capture":
            as_autopilot(log, truth, dice)
        if case["has_dvl"]:
            doppler_log(log, truth, dice)
        if case["has_pair"]:
            second_compass(log, dice)
        file = folder / ("log" + suffix)
    for fault in case["faults"]:
        kind = BY_NAME[fault["name"]]
        value = kind.plant(log, fault["size"], dice, truth) if kind.plant else kind.value(fault["size"], made[kind.name], truth)
        for name in kind.finds:
            values[name] = value
    if case["form"] == "tlog" and "delay.compass" in values:
        values["delay.compass"] += held(log)
    if not is_as_simulated:
        write(file, log)
    for each in ("truth.csv", "config.toml", "mission.toml", "effects.toml"):
        (folder / each).unlink(missing_ok=True)
    if not is_as_simulated:
        (folder / "sim.cap").unlink()
    return {"file": file.name, "values": values}


def audit(navcal, folder, case):
    command = [navcal, "audit", "--json", "-", str(folder / case["file"])]
    if case["form"] in MAP and case["vehicle"] == "reference":
        (folder / "map.toml").write_text(f'[column."{MAP[case["form"]]}"]\nmeaning = "motor_current"\nunit = "A"\n')
        command[2:2] = ["--map", str(folder / "map.toml")]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{case['number']}: {done.stderr}")
    (folder / "answer.json").write_text(done.stdout)
    return json.loads(done.stdout)


def has_interval(finding):
    return finding["value"] is not None and finding["low"] is not None and finding["low"] < finding["high"]


def judge_fault(fault, findings, values):
    """Verdict of a fault, and its findings with an interval that should contain the truth."""
    kind = BY_NAME[fault["name"]]
    mine = [finding for finding in findings if finding["name"] in kind.finds]
    named = [finding for finding in mine if finding["certainty"] in NAMED]
    verdicts = []
    for finding in named:
        truth = values.get(finding["name"])
        if truth is None or finding["value"] is None:
            verdicts.append("right")
            continue
        near = abs(finding["value"] - truth) <= NEAR * abs(truth)
        verdicts.append("right" if near or finding["low"] <= truth <= finding["high"] else "wrong")
    if verdicts:
        return "right" if "right" in verdicts else "wrong"
    return "cannot say" if any(finding["certainty"] == "cannot say" for finding in mine) else "missed"


def explained(finding, case):
    for fault in case["faults"]:
        kind = BY_NAME[fault["name"]]
        if finding["name"] in kind.finds + kind.also:
            return True
        if finding["name"] in kind.also_likely and finding["certainty"] == "likely":
            return True
    return False


def judge(case, answer):
    findings = answer["findings"]
    values = case["values"]
    asked = {name for fault in case["faults"] for name in BY_NAME[fault["name"]].finds}
    result = {"verdicts": {}, "false": [], "intervals": []}
    for fault in case["faults"]:
        result["verdicts"][fault["name"]] = judge_fault(fault, findings, values)
    for finding in findings:
        if finding["certainty"] in NAMED and not explained(finding, case):
            result["false"].append([finding["name"], finding["channel"], finding["value"], finding["low"], finding["high"], finding["certainty"]])
        # Of several instruments the fault is in one.
        of_another = (finding["name"] == ITS_HEADING and finding["channel"] != "attitude"
                      or finding["name"] == "gyro.rest" and not finding["channel"].endswith("rate_z"))
        truth = values.get(finding["name"])
        if finding["name"] in asked and truth is not None and finding["certainty"] in NAMED and has_interval(finding) and not of_another:
            result["intervals"].append([finding["name"], finding["low"] <= truth <= finding["high"], truth, finding["value"],
                                        finding["low"], finding["high"]])
    return result


def share(part, whole):
    return f"{part} of {whole} ({100 * part / whole:.0f} %)" if whole else "none"


def table(cases, results):
    lines = ["| fault | planted | right | wrong | cannot say | missed |", "|---|---|---|---|---|---|"]
    kinds = ("right", "wrong", "cannot say", "missed")
    counts = collections.defaultdict(collections.Counter)
    for result in results:
        for name, verdict in result["verdicts"].items():
            counts[name][verdict] += 1
    for name in [fault.name for fault in FAULTS if fault.name in counts]:
        row = counts[name]
        lines.append(f"| {name} | {sum(row.values())} | " + " | ".join(str(row[kind]) for kind in kinds) + " |")
    total = sum(counts.values(), collections.Counter())
    lines.append(f"| all | {sum(total.values())} | " + " | ".join(str(total[kind]) for kind in kinds) + " |")
    planted = sum(total.values())
    intervals = [interval for result in results for interval in result["intervals"]]
    nominal = [result for case, result in zip(cases, results) if not case["faults"]]
    faulty = [result for case, result in zip(cases, results) if case["faults"]]
    lines += ["", f"- right: {share(total['right'], planted)}; wrong values: {share(total['wrong'], planted)}",
              f"- false findings: {sum(len(r['false']) for r in nominal)} in {len(nominal)} nominal logs, "
              f"{sum(len(r['false']) for r in faulty)} in {len(faulty)} logs with faults",
              f"- intervals that hold: {share(sum(i[1] for i in intervals), len(intervals))}"]
    return "\n".join(lines)


def details(cases, results):
    lines = []
    for case, result in zip(cases, results):
        what = ", ".join(f"{fault['name']} {fault['size']}: {result['verdicts'][fault['name']]}" for fault in case["faults"])
        failed = [i for i in result["intervals"] if not i[1]]
        if not result["false"] and not failed and all(v == "right" for v in result["verdicts"].values()):
            continue
        lines.append(f"{case['number']} {case['form']} {case['vehicle']} {case['mission']} {case['place']}: {what}")
        lines += [f"    false {each}" for each in result["false"]] + [f"    does not hold {i}" for i in failed]
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("navcal")
    parser.add_argument("--seed", default="1")
    parser.add_argument("--folder", type=pathlib.Path, required=True)
    parser.add_argument("--cases", type=int, default=80)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--maker", help="program that simulates, if it is not NAVCAL")
    parser.add_argument("--only", type=int, nargs="*", help="numbers of cases")
    parser.add_argument("--details", action="store_true", help="every case that is not right")
    arguments = parser.parse_args()
    repository = pathlib.Path(__file__).resolve().parents[2]
    numbers = arguments.only or range(arguments.cases)
    arguments.folder.mkdir(parents=True, exist_ok=True)

    def made(number):
        folder = arguments.folder / f"{arguments.seed}-{number}"
        case = planned(arguments.seed, number, arguments.cases)
        if not (folder / "case.json").exists():
            case |= make(arguments.maker or arguments.navcal, repository, folder, case, arguments.seed)
            (folder / "case.json").write_text(json.dumps(case))
        return json.loads((folder / "case.json").read_text())

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        cases = list(pool.map(made, numbers))
        text = json.dumps(cases, indent=1)
        (arguments.folder / f"cases-{arguments.seed}.json").write_text(text)
        answers = list(pool.map(lambda case: audit(arguments.navcal, arguments.folder / f"{arguments.seed}-{case['number']}", case), cases))
    results = [judge(case, answer) for case, answer in zip(cases, answers)]
    (arguments.folder / f"results-{arguments.seed}.json").write_text(json.dumps(results))
    if arguments.details:
        print(details(cases, results) + "\n")
    print(f"{len(cases)} logs of {SECONDS} s, seed {arguments.seed}, SHA-256 of cases.json "
          f"{hashlib.sha256(text.encode()).hexdigest()[:16]}\n")
    print(table(cases, results))


if __name__ == "__main__":
    main()
