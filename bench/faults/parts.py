# SPDX-License-Identifier: Apache-2.0
"""The parts of `bench/reliability`: each measures, keeps its result as JSON, and says what must never be."""
import argparse
import datetime
import json
import os

import serial_rig as rig
from faults.arguments import SKIPPED
from faults import clock_part, faults_part, gpsd_part, kill_part, memory_part, network_part, storage_part

RESULTS = os.environ.get("RELIABILITY_RESULTS") or os.path.join(rig.ROOT, "build", "reliability")
PARTS = {"faults": faults_part, "clock": clock_part, "kill": kill_part, "storage": storage_part,
         "network": network_part, "gpsd": gpsd_part, "memory": memory_part}


def run(a):
    return keep(a, PARTS[a.part])


def keep(a, part):
    """Runs a part and keeps its result; returns its problems."""
    result, problems = part.run(a)
    result |= {"problems": problems, "date": datetime.date.today().isoformat(), "seed": a.seed,
               "command": part.command(a), "machine": json.loads(rig.machine())}
    os.makedirs(RESULTS, exist_ok=True)
    path = os.path.join(RESULTS, a.part + (".short" if a.short else "") + ".json")
    with open(path, "w") as f:
        json.dump(result, f, indent=1)
    print(json.dumps(result, indent=1))
    return problems


def run_all(a):
    problems = []
    for name, part in PARTS.items():
        parser = argparse.ArgumentParser()
        part.add(parser.add_subparsers(dest="part"))
        arguments = [name, "--seed", str(a.seed)]
        if name == "faults":
            arguments += ["--minutes", str(a.hours * 60)]
        try:
            problems += [f"{name}: {p}" for p in run(parser.parse_args(arguments))]
        except SystemExit as skipped:  # its reason stands on standard error
            if skipped.code != SKIPPED:
                raise
    return problems


def results(names):
    """What is there of them, in that order."""
    found = {}
    for name in names:
        path = os.path.join(RESULTS, name + ".json")
        if os.path.exists(path):
            with open(path) as f:
                found[name] = json.load(f)
    return found
