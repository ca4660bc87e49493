#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Parameters that `navcal calibrate --parameters` makes of a log, applied to the log's raw fields by formulas of its own.

usage: check_compass_parameters.py NAVCAL SOURCES
Logs of ArduPilot and PX4 are written, of a vehicle that turns about all axes, whose autopilot corrects its compass by a poor
calibration. The script applies ArduPilot's and PX4's formulas with the new parameters to what the compass had measured: the size
of the field then spreads as little as the parameter file promises of readings held out, and so many times less than before.
"""

import math
import os
import pathlib
import random
import re
import struct
import subprocess
import sys
import tempfile

NAVCAL = os.path.abspath(sys.argv[1])
sys.path.insert(0, os.path.join(sys.argv[2], "bench", "audit_trial"))
import writers  # noqa: E402

FIELD_UT = (19.0, 1.2, 44.0)
IRON, HARD_UT = ((1.06, 0.03, -0.02), (0.03, 0.95, 0.015), (-0.02, 0.015, 1.03)), (14.0, -9.0, 6.0)
START_S, SECONDS = 1_900_000_000, 400
PX4_DEVICE = 396825


def times(matrix, vector):
    return tuple(sum(a * b for a, b in zip(row, vector)) for row in matrix)


def plus(a, b, factor=1.0):
    return tuple(x + factor * y for x, y in zip(a, b))


def rotation(roll, pitch, yaw):
    """From the world to the body."""
    cr, sr, cp, sp, cy, sy = (f(angle) for angle in (roll, pitch, yaw) for f in (math.cos, math.sin))
    return ((cp * cy, cp * sy, -sp), (sr * sp * cy - cr * sy, sr * sp * sy + cr * cy, sr * cp),
            (cr * sp * cy + sr * sy, cr * sp * sy - sr * cy, cr * cp))


def angles(t):
    return 0.7 * math.sin(2 * math.pi * t / 31), 0.6 * math.sin(2 * math.pi * t / 43 + 1), 2 * math.pi * t / 50


def rates(t):
    roll, pitch, _ = angles(t)
    d = [(b - a) / 2e-4 for a, b in zip(angles(t - 1e-4), angles(t + 1e-4))]
    return (d[0] - d[2] * math.sin(pitch), d[1] * math.cos(roll) + d[2] * math.cos(pitch) * math.sin(roll),
            -d[1] * math.sin(roll) + d[2] * math.cos(pitch) * math.cos(roll))


def dive(correct):
    """A log whose fields are as `correct` makes them of the measured ones, and the measured ones in uT."""
    noise = random.Random(5)
    log, measured = {"imu": [], "compass": [], "attitude": []}, []
    for i in range(50 * SECONDS):
        t = i / 50
        turn, now = rotation(*angles(t)), START_S + t
        shaken = lambda values, std: tuple(value + noise.gauss(0, std) for value in values)
        log["imu"].append(writers.Sample(now, now, {"rate_rad_s": shaken(rates(t), 2e-3),
                                                    "specific_force_m_s2": shaken(times(turn, (0, 0, -9.81)), 0.02)}))
        if i % 5 == 0:
            measured.append(shaken(plus(times(IRON, times(turn, FIELD_UT)), HARD_UT), 0.15))
            log["compass"].append(writers.Sample(now, now, {"field_body_uT": correct(measured[-1])}))
            roll, pitch, yaw = angles(t)
            log["attitude"].append(writers.Sample(now, now, {"roll_rad": roll, "pitch_rad": pitch, "heading_rad": yaw % (2 * math.pi)}))
    return log, measured


def spread_percent(fields):
    sizes = [math.sqrt(sum(axis * axis for axis in field)) for field in fields]
    mean = sum(sizes) / len(sizes)
    return 100 * math.sqrt(sum((size - mean) ** 2 for size in sizes) / len(sizes)) / mean


def symmetric(diagonal, off):
    return ((diagonal[0], off[0], off[1]), (off[0], diagonal[1], off[2]), (off[1], off[2], diagonal[2]))


def ardupilot(values):
    """field = D (raw + OFS), in mGauss."""
    of = lambda kind: [values[f"COMPASS_{kind}_{axis}"] for axis in "XYZ"]
    return lambda raw_uT: times(symmetric(of("DIA"), of("ODI")), plus(raw_uT, of("OFS"), 0.1))


def px4(values):
    """field = D (raw - OFF), in gauss."""
    of = lambda kind: [values[f"CAL_MAG0_{axis}{kind}"] for axis in "XYZ"]
    return lambda raw_uT: times(symmetric(of("SCALE"), of("ODIAG")), plus(raw_uT, of("OFF"), -100))


POOR = {"OFS": (30.0, 20.0, -10.0), "DIA": (1.02, 1.0, 0.97), "ODI": (0.01, 0.0, -0.02)}


def write_dataflash(file):
    before = {f"COMPASS_{kind}_{axis}": value for kind, values in POOR.items() for axis, value in zip("XYZ", values)}
    log, measured = dive(ardupilot(before))
    writers.write_dataflash(file, log)
    flash = writers.DataFlash()
    for name, value in {**before, "COMPASS_MOTCT": 0, "COMPASS_SCALE": 0}.items():
        flash.add("PARM", 1000, name.encode(), value)
    file.write_bytes(flash.out + file.read_bytes())
    return measured


def write_ulog(file):
    kinds = {"OFF": [-value / 1000 for value in POOR["OFS"]], "SCALE": POOR["DIA"], "ODIAG": POOR["ODI"]}
    before = {f"CAL_MAG0_{axis}{kind}": value for kind, values in kinds.items() for axis, value in zip("XYZ", values)}
    log, measured = dive(px4(before))

    class ULog(writers.ULog):
        FORMATS = {**writers.ULog.FORMATS,
                   "vehicle_magnetometer": ("uint64_t timestamp;uint32_t device_id;float[3] magnetometer_ga;", "I3f")}

        def __init__(self, streams):
            super().__init__(streams)
            for name, value in before.items():
                self.parameter(b"float " + name.encode(), struct.pack("<f", value))
            for name, value in {"CAL_MAG0_ID": PX4_DEVICE, "CAL_MAG0_ROT": -1, "SENS_BOARD_ROT": 0, "CAL_MAG_COMP_TYP": 0}.items():
                self.parameter(b"int32_t " + name.encode(), struct.pack("<i", value))

        def parameter(self, key, value):
            self.message("P", bytes([len(key)]) + key + value)

        def data(self, number, name, us, *values):
            super().data(number, name, us, *([PX4_DEVICE] if name == "vehicle_magnetometer" else []), *values)

    plain, writers.ULog = writers.ULog, ULog
    writers.write_ulog(file, log)
    writers.ULog = plain
    return measured


def parameters(text):
    """Values by name, of both kinds of file, and the promise: percent of the field's size, before and after."""
    rows = [re.split(r"[\t,]", line) for line in text.splitlines() if not line.startswith("#")]
    promise = re.search(r"held out ([\d.]+) -> ([\d.]+) % of the field's size", text)
    return {row[-3] if len(row) == 5 else row[0]: float(row[3] if len(row) == 5 else row[1]) for row in rows}, promise


def judge(name, write, formula, ending):
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        measured = write(folder / name)
        run = lambda *words: subprocess.run([NAVCAL, *words], cwd=folder, check=True, capture_output=True, text=True)
        imported = run("log", "import", "-o", "dive.mcap", name)
        assert "as the autopilot has corrected them" not in imported.stderr + imported.stdout, imported.stderr
        told = run("calibrate", "--parameters", "compass" + ending, "dive.mcap")
        text = (folder / ("compass" + ending)).read_text()
        values, promise = parameters(text)
        assert promise, text
    before, after = spread_percent(measured), spread_percent([formula(values)(field) for field in measured])
    print(f"{name}: size of the field spreads by {before:.2f} -> {after:.2f} %; promised {promise[1]} -> {promise[2]} %")
    assert after < 1.2 * float(promise[2]) + 0.05, (after, text, told.stdout)
    assert before / after > 0.8 * float(promise[1]) / float(promise[2]), (before, after, text)


judge("dive.BIN", write_dataflash, ardupilot, ".param")
judge("dive.ulg", write_ulog, px4, ".param")  # of a PX4: in its format whatever the name
