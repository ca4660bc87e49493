# SPDX-License-Identifier: Apache-2.0
"""A client of the status socket that notes when each device was heard, and when a port was said to be away."""
import json
import re
import time

SAMPLE = re.compile(rb'^\{"class":"(?:ATT|TPV|MOTOR)"[^\n]*?"device":"([a-z]+)"')


class Watcher:
    def __init__(self, sock):
        self.sock, self.rest = sock, b""
        self.heard = {}   # device -> [monotonic ns], rising
        self.states = {}  # device -> [(monotonic ns, state)] as they changed
        self.health = None

    def pump(self):
        while True:
            try:
                data = self.sock.recv(65536)
            except BlockingIOError:
                return
            if not data:
                raise SystemExit("navcald closed the connection")
            now_ns = time.monotonic_ns()
            *lines, self.rest = (self.rest + data).split(b"\n")
            for line in lines:
                if found := SAMPLE.match(line):
                    self.heard.setdefault(found.group(1).decode(), []).append(now_ns)
                elif line.startswith(b'{"class":"HEALTH"'):
                    self.take_health(json.loads(line), now_ns)

    def take_health(self, health, now_ns):
        self.health = health
        for port in health["ports"]:
            states = self.states.setdefault(port["device"], [])
            if not states or states[-1][1] != port["state"]:
                states.append((now_ns, port["state"]))
