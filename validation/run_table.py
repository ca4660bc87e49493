#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Scores `navcal validate-runs` on runs whose cause is known: one folder of run files a label, one of them Normal.

usage: run_table.py NAVCAL FOLDER [--pool N]

The program is given the runs under neutral names and never the labels, which serve for the table alone. Pools are of N
consecutive runs (10) of one session; the sessions of a label are parted by gaps of more than 600 s between the seconds
of day with which file names begin. Each cause is also asked about with the cause taken out of the library.

A second table hides commands and battery: all runs, nominal ones too, get the same command once their thrusters run, and the
same voltage. It shows which answers rest on the command.

Normal runs are judged by a nominal vehicle that has not seen their session, in two ways: sessions parted by gaps, and
sessions as the program itself finds them; and once by one that has seen other runs of their sessions. Prints tables in Markdown.
"""

import argparse
import collections
import json
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import time

NORMAL = "Normal"
GAP_S = 600


def sessions_by_gap(files):
    """Lists of files, parted by gaps of the seconds of day in their names."""
    ordered = sorted(files, key=lambda file: (int(file.name.split("_")[0]), file.name))
    sessions = []
    for file in ordered:
        if sessions and int(file.name.split("_")[0]) - int(sessions[-1][-1].name.split("_")[0]) <= GAP_S:
            sessions[-1].append(file)
        else:
            sessions.append([file])
    return sessions


def pools_of(sessions, size):
    """Consecutive runs; what is left of a session is dropped, unless it is the whole of it."""
    pools = []
    for session in sessions:
        whole = [session[i : i + size] for i in range(0, len(session) - size + 1, size)]
        pools.extend(whole or [session])
    return pools


def with_hidden_inputs(text):
    """The run with one command for all running rows, and one voltage for all rows."""
    lines = text.split("\n")
    heading = lines[0].split(",")
    commands = [place for place, name in enumerate(heading) if name.startswith("pwm")]
    stop = float(lines[1].split(",")[commands[0]])
    for number, line in enumerate(lines[1:], 1):
        cells = line.split(",")
        if len(cells) != len(heading):
            continue
        for place in commands:
            cells[place] = "1198" if abs(float(cells[place]) - stop) > 10 else "1100"
        cells[heading.index("voltage")] = "12"
        lines[number] = ",".join(cells)
    return "\n".join(lines)


class Asking:
    """Runs the program on copies with neutral names."""

    def __init__(self, navcal):
        self.navcal = navcal
        self.hidden = False
        self.seconds = 0.0
        self.asked = 0

    def ask(self, nominal, runs, pools, removed=None):
        """Verdict and names, a pair each, of the runs and of the pools; and the sessions found among the nominal."""
        with tempfile.TemporaryDirectory() as scratch:
            scratch = pathlib.Path(scratch)
            names = {}
            for folder, files in (("nominal", nominal), ("runs", runs)):
                (scratch / folder).mkdir()
                for number, file in enumerate(files):
                    name = f"r{number:04}"
                    copy = scratch / folder / f"{name}.csv"
                    if self.hidden:
                        copy.write_text(with_hidden_inputs(file.read_text()))
                    else:
                        shutil.copyfile(file, copy)
                    if folder == "runs":
                        names[file] = name
            named = {f"p{number:03}": [names[file] for file in pool] for number, pool in enumerate(pools)}
            (scratch / "pools.json").write_text(json.dumps(named))
            command = [self.navcal, "validate-runs", "--nominal", scratch / "nominal", "--runs", scratch / "runs"]
            command += ["--pools", scratch / "pools.json", "--json", scratch / "answers.jsonl"]
            command += ["--sessions", scratch / "sessions.json"]
            command += ["--removed", removed] if removed else []
            began = time.monotonic()
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            self.seconds += time.monotonic() - began
            answers = [json.loads(line) for line in (scratch / "answers.jsonl").read_text().splitlines()]
            self.asked += len(answers)
            found = json.loads((scratch / "sessions.json").read_text())
            sessions = [[nominal[int(name[1:])] for name in session] for session in found.values()]
        singles = [outcome(answer) for answer in answers if "run" in answer]
        return singles, [outcome(answer) for answer in answers if "pool" in answer], sessions


def outcome(answer):
    """The verdict, or the names on which it rests, most probable first."""
    return [effect["name"] for effect in answer["effects"]] or [answer["verdict"]]


def family(name):
    return name.split("_")[0]


def share(count, total):
    return f"{count} of {total} ({100 * count / total:.0f} %)" if total else "none"


def row(arm, kind, outcomes, right):
    """A line of the table. `right` is the label, or no-gap."""
    count = collections.Counter()
    for names in outcomes:
        if names[0] in ("undecided", "unknown") and names[0] != right:
            count[names[0]] += 1
        elif names == [right]:
            count["exact"] += 1
        elif right in names:
            count["first of its family" if names[0] == right else "second of its family"] += 1
        elif right != "no-gap" and family(names[0]) == family(right):
            count["other size"] += 1
        else:
            count["wrong"] += 1
    total = len(outcomes)
    kinds = ("exact", "first of its family", "second of its family", "other size", "undecided", "unknown", "wrong")
    return f"| {arm} | {kind} | " + " | ".join(share(count[name], total) if count[name] else "0" for name in kinds) + " |"


def removed_row(arm, kind, outcomes):
    count = collections.Counter()
    for names in outcomes:
        if names[0] in ("unknown", "undecided", "no-gap"):
            count[names[0]] += 1
        else:
            count["its family" if family(names[0]) == family(arm) else "wrong"] += 1
    kinds = ("unknown", "its family", "undecided", "no-gap", "wrong")
    total = len(outcomes)
    return f"| {arm} | {kind} | " + " | ".join(share(count[name], total) if count[name] else "0" for name in kinds) + " |"


def print_table(navcal, folder, size):
    labels = {path.name: sorted(path.glob("*.csv")) for path in sorted(folder.iterdir()) if path.is_dir()}
    nominal = labels.pop(NORMAL)
    asking = Asking(navcal)
    print("| arm | | exact | size first | size second | other size | undecided | unknown | wrong |")
    print("|---|---|---|---|---|---|---|---|---|")
    removed_lines = []
    found = None
    for label, files in labels.items():
        pools = pools_of(sessions_by_gap(files), size)
        singles, pooled, found = asking.ask(nominal, files, pools)
        print(row(label, "pool", pooled, label))
        print(row(label, "run", singles, label), flush=True)
        singles, pooled, _ = asking.ask(nominal, files, pools, removed=label)
        removed_lines += [removed_row(label, "pool", pooled), removed_row(label, "run", singles)]
    for words, sessions in (("parted by gaps", sessions_by_gap(nominal)), ("as found", found)):
        singles, pooled = [], []
        for session in sessions:
            others = [file for file in nominal if file not in set(session)]
            asked = asking.ask(others, session, pools_of([session], size))
            singles += asked[0]
            pooled += asked[1]
        print(row(f"Normal, unseen sessions {words} ({len(sessions)})", "pool", pooled, "no-gap"))
        print(row(f"Normal, unseen sessions {words} ({len(sessions)})", "run", singles, "no-gap"), flush=True)
    singles, pooled = [], []
    for pool in pools_of(sessions_by_gap(nominal), size):
        asked = asking.ask([file for file in nominal if file not in set(pool)], pool, [pool])
        singles += asked[0]
        pooled += asked[1]
    print(row("Normal, unseen runs of sessions seen", "pool", pooled, "no-gap"))
    print(row("Normal, unseen runs of sessions seen", "run", singles, "no-gap"), flush=True)
    print("\n| cause, taken out of the library | | unknown | its family | undecided | no-gap | wrong |")
    print("|---|---|---|---|---|---|---|")
    print("\n".join(removed_lines))
    print("\n| arm, commands and battery hidden | | exact | size first | size second | other size | undecided | unknown | wrong |")
    print("|---|---|---|---|---|---|---|---|---|")
    asking.hidden = True
    for label, files in labels.items():
        print(row(label, "pool", asking.ask(nominal, files, pools_of(sessions_by_gap(files), size))[1], label))
    peak_MB = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1000
    print(f"\n{asking.asked} answers in {asking.seconds:.1f} s, at most {peak_MB:.0f} MB")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("navcal", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--pool", type=int, default=10, help="runs of a pool")
    arguments = parser.parse_args()
    if not (arguments.folder / NORMAL).is_dir():
        sys.exit(f"{arguments.folder}: no folder {NORMAL}")
    print_table(arguments.navcal.resolve(), arguments.folder, arguments.pool)


if __name__ == "__main__":
    main()
