#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The shipped log with planted faults: it is what its script makes, and `navcal audit` finds these faults, nothing else, and
the true values in its intervals.

usage: check_audit_sample.py NAVCAL SOURCE
"""

import itertools
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import tomllib

from check_dataflash import records


def is_same(a, b):
    """Up to rounding: another compiler or processor gives other last digits."""
    if isinstance(a, int):
        return abs(a - b) <= 1
    if isinstance(a, float):
        return math.isclose(a, b, rel_tol=1e-4, abs_tol=1e-5)
    return a == b


def check_script(navcal, source, sample):
    script = source / "bench" / "audit_trial" / "sample.py"
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, script, navcal, folder], check=True)
        made = pathlib.Path(folder, sample.name)
        count = 0
        for shipped, now in itertools.zip_longest(records(sample.read_bytes()), records(made.read_bytes())):
            same = None not in (shipped, now) and shipped[0] == now[0] and shipped[1].keys() == now[1].keys()
            assert same and all(is_same(shipped[1][key], now[1][key]) for key in now[1]), (
                f"record {count}: {shipped} is shipped, {now} is made now: python3 {script} NAVCAL {sample.parent}")
            count += 1
        assert made.with_suffix(".toml").read_text() == sample.with_suffix(".toml").read_text()
    print(f"{count} records are what the script makes")


def main():
    navcal, source = sys.argv[1], pathlib.Path(sys.argv[2])
    sample = source / "share" / "samples" / "three-faults.BIN"
    check_script(navcal, source, sample)
    faults = tomllib.loads(sample.with_suffix(".toml").read_text())["fault"]
    done = subprocess.run([navcal, "audit", "--json", "-", sample], check=True, capture_output=True, text=True)
    findings = [finding for finding in json.loads(done.stdout)["findings"] if finding["certainty"] in ("found", "likely")]
    assert sorted(finding["name"] for finding in findings) == sorted(fault["finding"] for fault in faults), findings
    assert len(faults) == 3
    for fault in faults:
        finding = next(finding for finding in findings if finding["name"] == fault["finding"])
        assert finding["certainty"] == "found" and finding["unit"] == fault["unit"], finding
        assert finding["low"] < fault["true_value"] < finding["high"], (fault, finding)
        print("{finding}: {true_value} {unit} is true".format(**fault), "and {value:.3f} ({low:.3f} to {high:.3f}) is found".format(**finding))


if __name__ == "__main__":
    main()
