#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A controller in a page: holds a heading at a constant shaft speed for some seconds.

    docs/examples/controller.py --control /run/navcal/control --status 2947 --heading 90 --rpm 600 --seconds 30

It takes a lease of the motor, answers each STATE of navcald with an order, ten times a second, and releases the lease.
It ends with status 1, and says why, when an order is refused. See docs/control.md.
"""
import argparse
import json
import math
import socket
import sys
import time

TIMEOUT_S = 2.0
PROPORTIONAL = 0.6  # degrees of rudder for a degree of heading
DAMPING_S = 0.5  # degrees of rudder for a degree a second
MOST_RUDDER_DEG = 15.0


class Control:
    """navcald's control socket: one JSON object a line, and one back."""

    def __init__(self, path):
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.connect(path)
        self.lines = self.socket.makefile("rw")

    def ask(self, **request):
        self.lines.write(json.dumps(request) + "\n")
        self.lines.flush()
        answer = json.loads(self.lines.readline())
        if not answer["ok"]:
            raise RuntimeError(f"{request['command']}: {answer['error']}")
        return answer


def states(port):
    """STATE after STATE, at 10 Hz."""
    status = socket.create_connection(("127.0.0.1", port))
    status.sendall(b'?WATCH={"enable":true,"json":true,"classes":["STATE"],"rate_Hz":{"STATE":10}};\n')
    for line in status.makefile():
        report = json.loads(line)
        if report["class"] == "ERROR":
            raise RuntimeError(report["message"])
        if report["class"] == "STATE":
            yield report


def rudder_deg(state, wanted_rad):
    """Positive turns to starboard. Without a heading the rudder stays amidships."""
    if state["heading_rad"] is None:
        return 0.0
    error_rad = math.remainder(wanted_rad - state["heading_rad"], 2 * math.pi)
    rate_rad_s = (state["rate_rad_s"] or [0, 0, 0])[2]
    rudder = math.degrees(PROPORTIONAL * error_rad - DAMPING_S * rate_rad_s)
    return max(-MOST_RUDDER_DEG, min(MOST_RUDDER_DEG, rudder))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--control", default="/run/navcal/control", help="navcald's control socket")
    parser.add_argument("--status", type=int, default=2947, help="TCP port of its status socket")
    parser.add_argument("--heading", type=float, default=0.0, help="degrees")
    parser.add_argument("--rpm", type=float, default=600.0, help="shaft speed")
    parser.add_argument("--seconds", type=float, default=10.0)
    a = parser.parse_args()
    control = Control(a.control)
    lease = control.ask(command="motor.lease", holder="example-py", priority=1, timeout_s=TIMEOUT_S)["lease"]
    end = time.monotonic() + a.seconds
    orders, latest_s = 0, 0.0
    for state in states(a.status):
        if time.monotonic() > end:
            break
        rudder = rudder_deg(state, math.radians(a.heading))
        control.ask(command="motor.order", lease=lease, shaft_rpm=a.rpm, fins_deg=[-rudder, rudder / 2, rudder / 2],
                    state_time=state["time"])
        orders += 1
        if state["order"]["late_s"] is not None:
            latest_s = max(latest_s, state["order"]["late_s"])
    control.ask(command="motor.release", lease=lease)
    print(f"{orders} orders, the latest {latest_s * 1000:.1f} ms after its state")


try:
    main()
except (OSError, RuntimeError) as error:
    sys.exit(f"controller.py: {error}")
