# SPDX-License-Identifier: Apache-2.0
"""netCDF4 (nobody of navcal wrote it) reads the export; every value must be the one in the CSV files."""
import calendar
import csv
import math
import pathlib
import sys
import time

import netCDF4

folder, path = pathlib.Path(sys.argv[1]), sys.argv[2]
DATES = {"time_s": "time", "arrival_s": "arrival"}
INTERVALS = {"monotonic_s": "monotonic", "offset_s": "offset", "at_s": "at"}
values = 0
# The state of the calibrators is one field, longer than the 128 kB that the reader takes otherwise.
csv.field_size_limit(1 << 24)


def nanoseconds(text):
    whole, _, fraction = text.partition(".")
    return int(whole + fraction.ljust(9, "0"))


def agrees(text, value, variable):
    if variable.dtype is str:
        return value == text
    if text == "":
        return math.isnan(value) if variable.dtype.kind == "f" else value == variable._FillValue
    if variable.name in DATES.values():
        midnight = calendar.timegm(time.strptime(variable.units, "seconds since %Y-%m-%d 00:00:00"))
        return round(value * 1e9) == nanoseconds(text) - midnight * 10**9
    if variable.dtype == "i8":
        return value == nanoseconds(text)
    if variable.dtype == "i1":
        return value == {"false": 0, "true": 1}[text]
    return value == float(text)


def check(condition, what):
    if not condition:
        sys.exit(f"{path}: {what}")


with netCDF4.Dataset(path) as file:
    file.set_auto_mask(False)
    file.set_auto_scale(False)
    check(file.Conventions == "CF-1.9", "conventions")
    check(file.navcal_configuration == (folder / "config.toml").read_text(), "configuration")
    tables = {table.stem: table for table in folder.glob("*.csv") if not table.stem.startswith("raw_")}
    check(set(file.groups) == set(tables), f"groups {sorted(file.groups)}, tables {sorted(tables)}")
    for name, table in tables.items():
        group = file.groups[name]
        rows = list(csv.reader(table.open(newline="")))
        heads, rows = rows[0], rows[1:]
        times = [nanoseconds(row[0]) for row in rows]
        increases = all(a < b for a, b in zip(times, times[1:]))
        dimension = "time" if increases else "sample"
        check(list(group.dimensions) == [dimension] and len(group.dimensions[dimension]) == len(rows), f"{name}: dimension")
        check(len(group.variables) == len(heads), f"{name}: {len(group.variables)} variables for {len(heads)} columns")
        for column, head in enumerate(heads):
            variable = group.variables[DATES.get(head) or INTERVALS.get(head) or head]
            check(variable.dimensions == (dimension,), f"{name}.{head}: dimensions")
            check(variable.long_name, f"{name}.{head}: no name in words")
            check(head not in DATES or variable.units.startswith("seconds since "), f"{name}.{head}: units")
            check(variable.dtype is str or variable.dtype == "i1" or variable.units, f"{name}.{head}: no units")
            check(increases or head == "time_s" or variable.coordinates == "time", f"{name}.{head}: coordinates")
            for row, (line, value) in enumerate(zip(rows, variable[:])):
                check(agrees(line[column], value, variable), f"{name}.{head}[{row}]: {value!r}, CSV {line[column]!r}")
                values += 1
    first = file["compass/time"]
    check(netCDF4.num2date(first[0], first.units, first.calendar).year == 2026, "the year")
print(f"{values} values in {len(tables)} groups are those of the CSV files")
