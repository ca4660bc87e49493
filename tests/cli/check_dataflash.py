#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares `navcal log import` of an ArduPilot DataFlash log with a reading of its own, from the format's description.

usage: check_dataflash.py NAVCAL FILE.BIN
Status 77, for a test that is skipped, when the file is missing.
"""

import collections
import json
import math
import os
import struct
import subprocess
import sys
import tempfile

SIZES = dict(a="64s", b="b", B="B", h="h", H="H", i="i", I="I", f="f", d="d", n="4s", N="16s", Z="64s", c="h", C="H", e="i",
             E="I", L="i", M="B", q="q", Q="Q")


def records(data):
    """(name, {column: raw value}) of each record."""
    formats = {128: ("FMT", 89, "<BB4s16s64s", "Type,Length,Name,Format,Columns".split(","))}
    at = 0
    while at + 3 <= len(data):
        assert data[at : at + 2] == b"\xa3\x95", at
        name, length, layout, columns = formats[data[at + 2]]
        values = struct.unpack(layout, data[at + 3 : at + length])
        if name == "FMT":
            text = [value.split(b"\0")[0].decode() for value in values[2:]]
            layout = "<" + "".join(SIZES[letter] for letter in text[1])
            formats[values[0]] = (text[0], values[1], layout, text[2].split(","))
        yield name, dict(zip(columns, values))
        at += length


def determinant(m):
    return sum(m[0][i] * (m[1][(i + 1) % 3] * m[2][(i + 2) % 3] - m[1][(i + 2) % 3] * m[2][(i + 1) % 3]) for i in range(3))


def solved(matrix, right):
    """Three linear equations by Cramer's rule."""
    replaced = [[row[:i] + [value] + row[i + 1 :] for row, value in zip(matrix, right)] for i in range(3)]
    return [determinant(one) / determinant(matrix) for one in replaced]


def compass_parameters(data):
    """Matrix and offsets (mGauss) of each compass: field = matrix (measured + offsets), where no motor and no scale has a part."""
    value = {}
    for name, row in records(data):
        if name == "PARM":
            value.setdefault(row["Name"].split(b"\0")[0].decode(), row["Value"])
    found = []
    for number in ("", "2", "3"):
        if f"COMPASS_DIA{number}_X" not in value:
            continue
        assert value["COMPASS_MOTCT"] == 0 and value[f"COMPASS_SCALE{number}"] in (0, 1)
        x, y, z = (value[f"COMPASS_DIA{number}_{axis}"] for axis in "XYZ")
        xy, xz, yz = (value[f"COMPASS_ODI{number}_{axis}"] for axis in "XYZ")
        found.append(([[x, xy, xz], [xy, y, yz], [xz, yz, z]], [value[f"COMPASS_OFS{number}_{axis}"] for axis in "XYZ"]))
    return found


def expected(data):
    """{port: [(time in us, {key: value})]} with values of the manual's units, converted by hand; and UTC at the time 0."""
    compasses = compass_parameters(data)
    found = collections.defaultdict(list)
    # Times of a log without UTC count from 2000-01-01.
    utc_us = 946684800 * 10**6
    primary_baro = next(row["Value"] for name, row in records(data) if name == "PARM" and row["Name"].startswith(b"BARO_PRIMARY"))
    for name, row in records(data):
        if name == "IMU":
            port = "imu" if row["I"] == 0 else f"imu{row['I'] + 1}"
            found[port].append((row["TimeUS"], {"rate_rad_s": [row["GyrX"], row["GyrY"], row["GyrZ"]],
                                                "specific_force_m_s2": [row["AccX"], row["AccY"], row["AccZ"]]}))
        elif name == "MAG":
            port = "compass" if row["I"] == 0 else f"compass{row['I'] + 1}"
            matrix, offsets = compasses[row["I"]]
            measured = solved(matrix, [row[axis] for axis in ("MagX", "MagY", "MagZ")])
            field = [(value - offset) / 10 for value, offset in zip(measured, offsets)]
            found[port].append((row["TimeUS"], {"field_body_uT": field}))
        elif name == "ATT":
            angles = {"roll_rad": math.radians(row["Roll"] / 100), "pitch_rad": math.radians(row["Pitch"] / 100),
                      "heading_rad": math.radians(row["Yaw"] / 100) % (2 * math.pi)}
            found["attitude"].append((row["TimeUS"], angles))
        elif name == "BAT":
            found["battery"].append((row["TimeUS"], {"voltage_V": row["Volt"], "current_A": row["Curr"]}))
        elif name == "GPS":
            fix = {"lat": row["Lat"] / 1e7, "lon": row["Lng"] / 1e7, "speed_m_s": row["Spd"], "course_rad": math.radians(row["GCrs"])}
            if row["Status"] >= 3 and not any("lat" in values for _, values in found["gps"]):
                gps_epoch_s, leap_s = 315964800, 18
                utc_us = (gps_epoch_s - leap_s + 604800 * row["GWk"]) * 10**6 + 1000 * row["GMS"] - row["TimeUS"]
            found["gps"].append((row["TimeUS"], fix if row["Status"] >= 3 else {}))
        elif name == "BARO" and row["I"] == primary_baro:
            depth = {"pressure_Pa": row["Press"], "temperature_C": row["Temp"] / 100, "depth_m": -row["Alt"]}
            found["depth"].append((row["TimeUS"], depth))
    return found, utc_us


def imported(navcal, file):
    """{port: [(UTC in us, line of the replay)]}"""
    with tempfile.TemporaryDirectory() as folder:
        log = os.path.join(folder, "imported.mcap")
        subprocess.run([navcal, "log", "import", "-o", log, file], check=True, stdout=subprocess.DEVNULL)
        replay = subprocess.run([navcal, "replay", "--json", log], check=True, capture_output=True, text=True)
    found = collections.defaultdict(list)
    for text in replay.stdout.splitlines():
        line = json.loads(text)
        if "device" in line:
            found[line["device"]].append((round(line["time"] * 1e6), line))
    return found


def near(a, b):
    if isinstance(b, list):
        return all(near(x, y) for x, y in zip(a, b))
    return abs(a - b) <= 1e-9 + 1e-12 * abs(b)


def main():
    navcal, file = sys.argv[1:]
    if not os.path.exists(file):
        print(f"{file} is not here")
        return 77
    with open(file, "rb") as opened:
        wanted, utc_us = expected(opened.read())
    found = imported(navcal, file)
    for port, rows in wanted.items():
        assert len(found[port]) == len(rows), (port, len(found[port]), len(rows))
        for (time_us, values), (found_us, line) in zip(rows, found[port]):
            # GPS time has milliseconds.
            assert abs(utc_us + time_us - found_us) <= (1000 if "gps" in wanted else 1), (port, time_us, found_us - utc_us)
            for key, value in values.items():
                assert near(line[key], value), (port, time_us, key, value, line[key])
        print(f"{port}: {len(rows)} samples agree")
    return 0


if __name__ == "__main__":
    sys.exit(main())
