#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sends the readings of a mission sensor to navcald, through the Unix socket of a port of protocol `samples`.

usage: inject_samples.py [--socket PATH] < readings.txt

Each line of standard input is `quantity unit value`, such as `oxygen umol/l 250.5`. The reading counts for the moment
at which its line was read. A program that knows the moment better puts that into `time`: UTC in seconds.
"""

import argparse
import json
import socket
import sys
import time


def line_of(quantity, unit, value):
    """One line of the socket: a flat JSON object. Nanoseconds need more digits than a float has."""
    now_ns = time.time_ns()
    values = json.dumps({"quantity": quantity, "unit": unit, "value": float(value)})
    moment = f'"time":{now_ns // 10**9}.{now_ns % 10**9:09d},"time_std":0.01'
    return f'{{"class":"SENSOR",{moment},{values[1:]}\n'


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--socket", default="/run/navcal/samples", help="the port's address behind unix-listen:")
    arguments = parser.parse_args()
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as navcald:
        navcald.connect(arguments.socket)
        for reading in sys.stdin:
            words = reading.split()
            if len(words) != 3:
                print(f"not `quantity unit value`: {reading.strip()}", file=sys.stderr)
                continue
            navcald.sendall(line_of(*words).encode())


if __name__ == "__main__":
    main()
