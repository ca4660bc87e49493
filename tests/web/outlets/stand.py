# SPDX-License-Identifier: Apache-2.0
"""What the tests of navcal-web with other programs share: a stand-in for navcald whose words are known, free ports, waiting,
and processes that are ended whatever happens."""
import contextlib
import json
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time
import urllib.request

SKIPPED = 77
LIMIT_S = 90  # for what takes a second on an idle machine


def need(*programs):
    """Ends the test as skipped when a program is not installed."""
    for program in programs:
        if shutil.which(program, path=os.environ["PATH"] + ":/usr/sbin:/sbin") is None:
            print(f"skipped: there is no {program} here")
            sys.exit(SKIPPED)


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def wait_for(what, condition, limit_s=LIMIT_S):
    """The first true value of condition(). Its OSErrors count as not yet."""
    deadline = time.monotonic() + limit_s
    problem = None
    while time.monotonic() < deadline:
        try:
            value = condition()
            if value:
                return value
        except (OSError, ValueError, KeyError) as error:
            problem = error
        time.sleep(0.05)
    raise AssertionError(f"waited {limit_s} s for: {what} ({problem})")


def get(url):
    with urllib.request.urlopen(url, timeout=LIMIT_S) as answer:
        return answer.headers.get("Content-Type"), answer.read().decode()


def get_json(url):
    return json.loads(get(url)[1])


def utc():
    return time.clock_gettime(time.CLOCK_REALTIME)


def health(**changes):
    """A HEALTH as navcald sends it, with one running port and one that has never answered."""
    clock = {"locked": True, "timing": "periodic", "period_s": 0.1, "skew_ppm": 12.5, "skew_std_ppm": 0.5, "jitter_s": 2e-4,
             "resets": 1}
    running = {"device": "compass", "protocol": "tcm2", "state": "running", "reason": "", "path": "/dev/ttyUSB0",
               "low_latency": "on", "opened": 1, "bytes": 123456, "frames": 1234, "samples": 1230, "bad": 3, "skipped": 21,
               "held": 0, "out_of_range": 1, "gaps": 2, "lost": 4, "repeated": 0, "clock": clock,
               "latency_log2_us": [0, 0, 0, 0, 0, 0, 1, 40, 900, 280, 9], "latency_sum_s": 0.25}
    away = {**running, "device": "imu", "state": "away", "reason": "there is no /dev/imu", "bytes": 0, "frames": 0,
            "samples": 0, "bad": 0, "latency_log2_us": []}
    message = {"class": "HEALTH", "alarms": [{"alarm": "leak_aft", "device": "imu"}], "time": utc(), "uptime_s": 321.5,
               "sources": {"heading": "compass"},
               "earth_field": {"declination_source": "model", "declination": 4.5, "size_source": "none"},
               "ports": [running, away],
               "log": {"enabled": True, "state": "writing", "reason": "", "file": "navcal-1.mcap", "bytes": 5000,
                       "synced": 4000, "queued": 100, "lost": 0},
               "clients": 2, "client_queue_bytes": 0, "client_dropped": 7}
    return {**message, **changes}


def nav(**changes):
    message = {"class": "NAV", "time": utc(), "time_std": 5e-4, "arrival": utc(), "device": "navigation", "position": "reckoned",
               "lat": 59.3326, "lon": 18.0649, "north_std_m": 1.5, "east_std_m": 2.5, "since_fix_s": 25.0, "since_fix_m": 27.9,
               "depth_m": 6.25, "heading_rad": 1.25, "heading_std_rad": 0.0875, "pitch_rad": -0.2, "roll_rad": 0.01,
               "speed_m_s": 1.125, "speed_source": "shaft", "bottom_lock": None, "dvl_outliers": None,
               "velocity_m_s": [0.0, 1.0, 0.25], "set_north_m_s": 0.0, "set_east_m_s": -0.125, "altitude_m": None,
               "altitude_std_m": None, "water_depth_m": None, "predicted_error_m": 3.5, "surface_within_s": None,
               "calibration": None}
    return {**message, **changes}


def compass(**changes):
    message = {"class": "COMPASS", "time": utc(), "time_std": 0.002, "arrival": utc(), "device": "compass", "heading_rad": 1.2,
               "heading_calibrated_rad": 1.175, "heading_is_true": False, "pitch_rad": -0.2, "roll_rad": 0.01,
               "heading_std_rad": 0.0088, "calibration": "7-1a2b3c4d"}
    return {**message, **changes}


def imu(**changes):
    message = {"class": "IMU", "time": utc(), "time_std": 5e-4, "arrival": utc(), "device": "imu",
               "rate_rad_s": [0.01, 0.02, 0.03], "yaw_rate_calibrated_rad_s": 0.025, "rate_std_rad_s": 0.0017}
    return {**message, **changes}


def battery(**changes):
    message = {"class": "BATTERY", "time": utc(), "time_std": 0.01, "device": "gauge", "voltage_V": 22.5, "current_A": 1.5,
               "current_measured": True, "charge_Ah": 2.0, "charge_std_Ah": 0.05, "charge_percent": 50.0, "energy_Wh": 44.0,
               "time_left_s": 4800.0, "range_left_m": 5400.0, "low": False}
    return {**message, **changes}


def clock(source="gps", bound=0.02, **changes):
    """The mapping of this machine's own clocks."""
    monotonic = time.clock_gettime(time.CLOCK_MONOTONIC)
    message = {"class": "TIME", "time": utc(), "monotonic": monotonic, "source": source, "offset": utc() - monotonic,
               "bound": bound, "at": monotonic}
    return {**message, **changes}


def event(text, severity="info"):
    return {"class": "EVENT", "time": utc(), "monotonic": 1.0, "severity": severity, "name": "mark", "port": "", "message": text}


class FakeNavcald:
    """The status socket of a navcald. `say` sends a record to all who watch; `every` sends what a function makes."""

    def __init__(self, port=None):
        self.port = port or free_port()
        self.listener = socket.create_server(("127.0.0.1", self.port), reuse_port=False)
        self.clients, self.watching, self.sources, self.lock = [], set(), [], threading.Lock()
        self.policies = []
        self.open = True
        threading.Thread(target=self._accept, daemon=True).start()
        threading.Thread(target=self._repeat, daemon=True).start()

    def every(self, interval_s, topic, device, make):
        self.sources.append([interval_s, 0.0, topic, device, make])

    def say(self, topic, device, message):
        text = json.dumps({"class": "RECORD", "topic": topic, "device": device, "time": message.get("time"),
                           "message": message}, separators=(",", ":")) + "\n"
        with self.lock:
            for client in list(self.watching):
                with contextlib.suppress(OSError):
                    client.sendall(text.encode())

    def close(self):
        self.open = False
        self.listener.close()
        with self.lock:
            for client in self.clients:
                with contextlib.suppress(OSError):
                    client.shutdown(socket.SHUT_RDWR)
                client.close()

    def _accept(self):
        while self.open:
            try:
                client, _ = self.listener.accept()
            except OSError:
                return
            with self.lock:
                self.clients.append(client)
            threading.Thread(target=self._serve, args=(client,), daemon=True).start()

    def _serve(self, client):
        with contextlib.suppress(OSError):
            client.sendall(b'{"class":"VERSION","release":"navcal","proto_major":3,"proto_minor":14}\n')
            for line in client.makefile(encoding="utf-8"):
                if line.startswith("?RECORDS"):
                    client.sendall(b'{"class":"RECORDS","topics":[]}\n')
                elif line.startswith("?WATCH="):
                    self.policies.append(json.loads(line[len("?WATCH="):].rstrip(";\n")))
                    with self.lock:
                        self.watching.add(client)
                    client.sendall(b'{"class":"WATCH","enable":true}\n')
        with self.lock:
            self.watching.discard(client)

    def _repeat(self):
        while self.open:
            for source in self.sources:
                interval_s, due, topic, device, make = source
                now = time.monotonic()
                if now >= due:
                    source[1] = now + interval_s
                    self.say(topic, device, make())
            time.sleep(0.01)


class Stand(contextlib.ExitStack):
    """Folder, processes and stand-ins of one test; all of them end with it."""

    def __init__(self):
        super().__init__()
        self.folder = self.enter_context(tempfile.TemporaryDirectory(prefix="navcal-outlets-"))
        os.chmod(self.folder, 0o755)  # some programs give up their rights

    def navcald(self, port=None):
        fake = FakeNavcald(port)
        self.callback(fake.close)
        return fake

    def usual_navcald(self):
        """With every topic that the outlets take, at rates like the real one's."""
        fake = self.navcald()
        for interval_s, topic, device, make in ((0.5, "/health", None, health), (0.1, "/nav", "navigation", nav),
                                                (0.05, "/compass", "compass", compass), (0.05, "/imu", "imu", imu),
                                                (0.5, "/battery", "gauge", battery), (1, "/time", None, clock)):
            fake.every(interval_s, topic, device, make)
        return fake

    def start(self, *command, **options):
        """A program whose output goes to a file of its own, shown when the test fails."""
        name = os.path.basename(command[0])
        path = os.path.join(self.folder, f"{name}.log")
        out = self.enter_context(open(path, "ab"))
        process = subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT, **options)
        self.callback(self.end, process)
        self.push(lambda kind, *_: kind and print(f"--- {name}:\n" + open(path, errors="replace").read()[-4000:]) and None)
        return process

    @staticmethod
    def end(process):
        if process.poll() is None:
            process.terminate()
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait(20)

    def web(self, program, navcald, *options):
        """navcal-web of this navcald; returns its address, once it answers."""
        port = free_port()
        self.web_process = self.start(program, "--port", str(port), "--status", f"127.0.0.1:{navcald.port}", *options)

        def answers():
            if self.web_process.poll() is not None:
                raise AssertionError(f"navcal-web has ended with {self.web_process.returncode}")
            return get(f"http://127.0.0.1:{port}/metrics")
        wait_for("navcal-web answers", answers)
        return f"http://127.0.0.1:{port}"
