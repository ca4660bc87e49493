#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the shipped sample: an ArduPilot DataFlash log of 400 seconds with three planted faults, and the truth beside it.

    python3 bench/audit_trial/sample.py NAVCAL FOLDER

writes FOLDER/three-faults.BIN and FOLDER/three-faults.toml. The same program makes the same bytes.
"""
import math
import pathlib
import sys
import tempfile

from faults import delayed, gyro_bias, hard_iron, iron_value
from vehicles import as_autopilot, random_of, samples_of, simulated
from writers import write_dataflash

MISSION = """mission.description = "Straight on, circles at the surface, steep spirals"
start.depth_m = 0.15
start.shaft_rpm = 700
step = [
  {do = "surface", seconds = 30},
  {do = "circle", turns = 2, rate_deg_s = 15},
  {do = "circle", turns = -2, rate_deg_s = 20},
  {do = "spiral", turns = 2, depth_m = 8, rate_deg_s = 25, shaft_rpm = 780},
  {do = "spiral", turns = -2, depth_m = 1, rate_deg_s = 25},
  {do = "surface", seconds = 30, shaft_rpm = 700},
  {do = "circle", turns = 2, rate_deg_s = 15},
  {do = "circle", turns = -2, rate_deg_s = 20},
  {do = "spiral", turns = -2, depth_m = 8, rate_deg_s = 25, shaft_rpm = 780},
  {do = "spiral", turns = 2, depth_m = 1, rate_deg_s = 25},
  {do = "surface", seconds = 30, shaft_rpm = 700},
]
"""
CASE = {"simulator_seed": 8, "mission": MISSION, "vehicle": "reference", "place": (44.6, -63.5), "seconds": 400}
IRON_DEG, BIAS_DEG_S, LATE_S = 12, 0.3, 1.4
# An autopilot whose compass was never calibrated.
PARAMETERS = {"BARO_PRIMARY": 0, "COMPASS_USE": 1, "COMPASS_MOTCT": 0, "COMPASS_SCALE": 0}
PARAMETERS |= {f"COMPASS_{group}_{axis}": neutral for group, neutral in (("OFS", 0), ("DIA", 1), ("ODI", 0), ("MOT", 0)) for axis in "XYZ"}

TRUTH = """# What is true of three-faults.BIN, a log of the simulator made by bench/audit_trial/sample.py.
# `navcal audit three-faults.BIN` finds these three faults and no other: each true value lies in its interval.
# Everything else in the log is right within the noise of the instruments; the attitude (ATT) does not come from the faulty compass.
{}"""
FAULT = """
# {}
[[fault]]
finding = "{}"
true_value = {:.3f}
unit = "{}"
"""


def main():
    navcal, out = sys.argv[1], pathlib.Path(sys.argv[2])
    dice = random_of("sample", 1)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        repository = pathlib.Path(__file__).resolve().parents[2]
        probe = simulated(navcal, repository, folder, CASE | {"mission": "survey"}, "")
        text, iron = hard_iron(IRON_DEG, dice, math.hypot(*probe.field_ned[:2]))
        truth = simulated(navcal, repository, folder, CASE, text)
        log = samples_of(navcal, folder / "sim.cap")
    as_autopilot(log, truth, dice)
    bias = gyro_bias(log, BIAS_DEG_S, dice, truth)
    late = delayed("gps")(log, LATE_S, dice, truth)
    write_dataflash(out / "three-faults.BIN", log, PARAMETERS)
    faults = [("Hard iron at the compass of {:.1f}, {:.1f}, {:.1f} uT (forward, right, down): the largest error of the heading that it makes.".format(*iron),
               "compass.iron", iron_value(None, iron, truth), "deg"),
              ("The gyro shows this rate too much about the vertical axis.", "gyro.rest", bias, "deg/s"),
              ("Fixes of the receiver are logged that much too late.", "delay.course", late, "s")]
    (out / "three-faults.toml").write_text(TRUTH.format("".join(FAULT.format(*fault) for fault in faults)))


if __name__ == "__main__":
    main()
