#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`navcal-web --mavlink` beside navcald on emulated instruments: what node-mavlink decodes (listener.mjs) is what navcald said at
the same stamp, field by field, and a peer that goes away disturbs nothing.

usage: check_outlet.py NAVCAL NAVCALD NAVCAL_WEB
"""

import contextlib
import datetime
import functools
import hashlib
import json
import math
import operator
import os
import pathlib
import re
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
import tty
import urllib.request

NAVCAL, NAVCALD, NAVCAL_WEB = (os.path.abspath(program) for program in sys.argv[1:4])
HERE = pathlib.Path(__file__).parent
if not (HERE / "node_modules/node-mavlink").is_dir():
    print(f"skipped: node-mavlink is not installed (npm ci in {HERE})")
    sys.exit(77)
TILT_STD_DEG = 0.5
PASSPHRASE = "a passphrase of forty characters, or more"
EVENT = "a mark that is longer than fifty characters, so that it has to go out in three pieces, which a ground station joins again"


def free_port(kind):
    with socket.socket(socket.AF_INET, kind) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def wait_for(what, condition, limit_s=150):
    deadline = time.monotonic() + limit_s
    while time.monotonic() < deadline:
        try:
            if found := condition():
                return found
        except OSError:
            pass
        time.sleep(0.05)
    raise AssertionError(f"waited {limit_s} s for {what}")


def single(value):
    """As a float of 32 bits has it."""
    return struct.unpack("<f", struct.pack("<f", value))[0]


class Listener:
    """node-mavlink at the other end of one navcal-web."""

    def __init__(self, stand, port, *key):
        self.heard = []
        self.process = stand.start("listener", "node", HERE / "listener.mjs", port, *key)
        threading.Thread(target=lambda: [self.heard.append(json.loads(line)) for line in self.process.stdout], daemon=True).start()

    def of(self, number):
        return [said for said in self.heard if said.get("id") == number]

    def end(self):
        self.process.kill()
        self.process.wait()


class Web:
    def __init__(self, stand, *options):
        self.http, self.mavlink = free_port(socket.SOCK_STREAM), free_port(socket.SOCK_DGRAM)
        self.process = stand.start("navcal-web", NAVCAL_WEB, "--port", self.http, "--status", f"127.0.0.1:{stand.status}", "--mavlink",
                                   f"udp:127.0.0.1:{self.mavlink}", *options)

    def metric(self, name):
        with urllib.request.urlopen(f"http://127.0.0.1:{self.http}/metrics", timeout=20) as page:
            for line in page.read().decode().splitlines():
                if line.startswith(f"navcal_web_mavlink_{name} "):
                    return float(line.split()[1])
        return None


class Stand:
    def __init__(self, folder):
        self.folder, self.processes, self.navs = pathlib.Path(folder), [], {}

    def start(self, name, *command):
        with open(self.folder / f"{name}.log", "ab") as log:
            process = subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE if name == "listener" else log, stderr=log,
                                       text=True)
        self.processes.append(process)
        return process

    def receiver(self):
        """A GPS receiver that has its fix at once, where the emulated vehicle begins. Of the emulated one it would take a minute."""
        master, self.slave = os.openpty()
        tty.setraw(self.slave)
        os.set_blocking(master, False)

        def speak():
            while True:
                time.sleep(1 - time.time() % 1)
                now = datetime.datetime.fromtimestamp(round(time.time()), datetime.timezone.utc)
                for text in (f"GPRMC,{now:%H%M%S}.00,A,5919.9560,N,01803.8940,E,1.0,90.0,{now:%d%m%y},,,A",
                             f"GPGGA,{now:%H%M%S}.00,5919.9560,N,01803.8940,E,1,08,0.9,12.0,M,24.0,M,,"):
                    with contextlib.suppress(OSError):
                        os.write(master, f"${text}*{functools.reduce(operator.xor, text.encode()):02X}\r\n".encode())
        threading.Thread(target=speak, daemon=True).start()
        return os.ttyname(self.slave)

    def navcald(self):
        lines = ['log.enabled = false', f'log.directory = "{self.folder}"', f'status.port = {self.status}', f'control.socket = "{self.folder}/control"',
                 "navigation.interval_s = 0.05"]
        lines += ["[port.gps]", 'protocol = "nmea"', f'path = "{self.receiver()}"']
        for port, protocol in (("compass", "tcm2"), ("imu", "imu-card"), ("motor", "motor-card")):
            lines += [f'[port.{port}]', f'protocol = "{protocol}"', f'path = "{self.folder}/ports/{port}"']
            lines += ["baud = 38400"] if port == "compass" else []
        (self.folder / "navcald.toml").write_text("\n".join(lines) + "\n")
        return self.start("navcald", NAVCALD, "--config", self.folder / "navcald.toml")

    def watch(self):
        """Keeps every estimate of navcald, by its time in microseconds."""
        with socket.create_connection(("127.0.0.1", self.status)) as status:
            status.sendall(b'?WATCH={"enable":true,"json":true,"classes":["RECORD"],"topics":["/nav"]};\n')
            for line in status.makefile(encoding="utf-8"):
                said = json.loads(line)
                stamp = re.search(r'"time":(\d+)\.(\d{9})', line)  # a float of 64 bits has no room for it
                if said["class"] == "RECORD" and stamp:
                    self.navs[int(stamp[1] + stamp[2]) // 1000] = said["message"]

    def command(self, **request):
        with socket.socket(socket.AF_UNIX) as control:
            control.connect(f"{self.folder}/control")
            control.sendall(json.dumps(request).encode() + b"\n")
            assert json.loads(control.makefile().readline())["ok"]


def rotation(roll, pitch, heading):
    """Body (forward, starboard, down) to north, east, down."""
    (cr, sr), (cp, sp), (cy, sy) = ((math.cos(a), math.sin(a)) for a in (roll, pitch, heading))
    return [[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr], [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr]]


def turned(q, v):
    """v by the quaternion w, x, y, z."""
    w, x, y, z = q
    t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])]
    return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2], v[2] + w * t[2] + x * t[1] - y * t[0]]


def near(found, expected, tolerance):
    assert abs(found - expected) <= tolerance, (found, expected)


def metres_each_radian(lat):
    """Northward and eastward, on the ellipsoid."""
    square = 1 - 0.00669437999 * math.sin(lat) ** 2
    return 6378137 * (1 - 0.00669437999) / square ** 1.5, 6378137 / math.sqrt(square) * math.cos(lat)


def origin_of(said, nav):
    """Where x and y are 0: the first position, which may have gone out before the listener was there."""
    north, east = metres_each_radian(math.radians(nav["lat"]))
    return nav["lat"] - math.degrees(said["fields"]["x"] / north), nav["lon"] - math.degrees(said["fields"]["y"] / east)


def check_odometry(said, nav, origin):
    fields = said["fields"]
    assert (fields["frameId"], fields["childId"] if "childId" in fields else fields["childFrameId"]) == (20, 12), fields
    assert (fields["quality"], fields["estimatorType"]) == (0, 0)
    # Within a few hundred metres of the origin.
    for name, place, zero, metres in zip(("x", "y"), (nav["lat"], nav["lon"]), origin, metres_each_radian(math.radians(origin[0]))):
        away = math.radians(place - zero) * metres
        near(fields[name], away, 0.01 + 1e-4 * abs(away))
    assert fields["z"] == single(nav["depth_m"])
    body = rotation(nav["roll_rad"], nav["pitch_rad"], nav["heading_rad"])
    for axis in range(3):  # the quaternion turns each axis of the body as the angles do
        unit = [float(i == axis) for i in range(3)]
        for i, component in enumerate(turned(fields["q"], unit)):
            near(component, body[i][axis], 1e-6)
    for axis, name in enumerate(("vx", "vy", "vz")):
        near(fields[name], sum(body[i][axis] * nav["velocity_m_s"][i] for i in range(3)), 1e-5)
    assert [fields[name] for name in ("rollspeed", "pitchspeed", "yawspeed")] == ["NaN"] * 3
    assert fields["velocityCovariance"] == ["NaN"] * 21
    diagonal = {0: nav["north_std_m"], 6: nav["east_std_m"], 11: nav["depth_std_m"], 15: math.radians(TILT_STD_DEG),
                18: math.radians(TILT_STD_DEG), 20: nav["heading_std_rad"]}
    is_known = all(std is not None for std in diagonal.values())
    for i, variance in enumerate(fields["poseCovariance"]):
        if is_known and i in diagonal:
            near(variance, diagonal[i] ** 2, 1e-6 * diagonal[i] ** 2)
        else:
            assert variance == "NaN", (i, variance)
    return is_known


def check_gps(said, nav, is_north_known):
    fields = said["fields"]
    near(fields["lat"], nav["lat"] * 1e7, 0.51)
    near(fields["lon"], nav["lon"] * 1e7, 0.51)
    assert fields["ignoreFlags"] == 1 + 2 + 4 + 32 + 128 and fields["fixType"] == 3
    assert [fields[name] for name in ("vn", "ve", "vd")] == [single(v) for v in nav["velocity_m_s"]]
    near(fields["horizAccuracy"], math.hypot(nav["north_std_m"], nav["east_std_m"]), 1e-5)
    assert 1 <= fields["yaw"] <= 36000 or (fields["yaw"] == 0 and not is_north_known), fields
    assert not fields["yaw"] or near((fields["yaw"] - math.degrees(nav["heading_rad"]) * 100 + 18000) % 36000, 18000, 0.51) is None
    gps_ms = fields["timeWeek"] * 604_800_000 + fields["timeWeekMs"]
    near(gps_ms, (nav["time"] - 315_964_800 + 18) * 1e3, 1)


def joined_texts(said):
    texts, parts = [], {}
    for one in said:
        fields = one["fields"]
        if fields["id"] == 0:
            texts.append((fields["severity"], fields["text"]))
            continue
        parts.setdefault(fields["id"], []).append(fields["text"])
        assert fields["chunkSeq"] == len(parts[fields["id"]]) - 1
        if len(fields["text"]) < 50:
            texts.append((fields["severity"], "".join(parts.pop(fields["id"]))))
    return texts


def check_fields(said, navs):
    """Every frame against the estimate of the same stamp. Returns the number of estimates with a covariance."""
    assert not any("bad" in one for one in said), "a frame did not decode"
    assert {(one["system"], one["component"]) for one in said} == {(1, 197)}
    assert all(one["trimmed"] for one in said)
    of = lambda number: [one for one in said if one["id"] == number]  # noqa: E731
    origin_at = int(of(331)[0]["fields"]["timeUsec"])
    origin = origin_of(of(331)[0], navs[origin_at])
    known = [check_odometry(one, navs[int(one["fields"]["timeUsec"])], origin) for one in of(331)]
    for one in of(232):
        at = int(one["fields"]["timeUsec"])
        check_gps(one, navs[at], is_north_known=at > origin_at)
    stamps = [one["fields"]["timeUsec"] for one in of(331)]
    assert len(set(stamps)) == len(stamps), "an estimate was sent twice"
    assert {"hdg_std", "pos_std", "fix_age"} <= {one["fields"]["name"] for one in of(251)}
    beat = of(0)[0]["fields"]
    assert (beat["type"], beat["autopilot"], beat["systemStatus"]) == (18, 8, 4), beat
    # Its clock is that of the stamps.
    assert of(111) and all(abs(int(one["fields"]["tc1"]) * 1e-9 - time.time()) < 300 for one in of(111))
    print(f"{len(said)} frames, all decoded: {len(known)} ODOMETRY ({sum(known)} with covariance), {len(of(232))} GPS_INPUT, "
          f"{len(of(251))} NAMED_VALUE_FLOAT, {len(of(253))} STATUSTEXT, {len(of(111))} TIMESYNC")
    return sum(known)


def run(stand):
    stand.status = free_port(socket.SOCK_STREAM)
    emulator = stand.start("emulate", NAVCAL, "emulate", "--mission", "survey", "--dir", stand.folder / "ports", "--seed", "5")
    wait_for("the emulated instruments", lambda: "ready" in (stand.folder / "emulate.log").read_text())
    daemon = stand.navcald()
    wait_for("navcald", lambda: socket.create_connection(("127.0.0.1", stand.status)).close() is None)
    threading.Thread(target=stand.watch, daemon=True).start()
    # One as it is, and one that signs both ways with a passphrase, of which nobody else may have a copy.
    key = stand.folder / "key"
    key.write_text(PASSPHRASE + "\n")
    os.chmod(key, 0o644)
    assert Web(stand, "--mavlink-key-file", key).process.wait(60) == 1
    assert "chmod 600" in (stand.folder / "navcal-web.log").read_text()
    os.chmod(key, 0o600)
    web, signing = Web(stand, "--mavlink-gps-rate", "5", "--mavlink-tilt-std", TILT_STD_DEG), Web(stand, "--mavlink-key-file", key)
    listener = Listener(stand, web.mavlink)
    signer = Listener(stand, signing.mavlink, hashlib.sha256(PASSPHRASE.encode()).hexdigest())
    wait_for("a position", lambda: listener.of(331))
    wait_for("the metric", lambda: web.metric("position") == 1)
    lost = web.metric("dropped_messages_total")  # before there was a listener
    stand.command(command="event", text=EVENT)
    for number, count in ((331, 100), (232, 20), (251, 9), (111, 2), (0, 3)):
        wait_for(f"{count} of message {number}", lambda number=number, count=count: len(listener.of(number)) >= count)
    texts = wait_for("the event", lambda: [text for text in joined_texts(listener.of(253)) if text[1].endswith(EVENT)])
    assert texts == [(6, EVENT)], texts

    # A peer that is stopped, and gone: navcald and the others see nothing of it.
    listener.process.send_signal(signal.SIGSTOP)
    navs = len(stand.navs)
    wait_for("estimates go on", lambda: len(stand.navs) > navs + 20)
    listener.end()
    navs = len(stand.navs)
    wait_for("estimates go on", lambda: len(stand.navs) > navs + 20)
    back = Listener(stand, web.mavlink)
    wait_for("the peer that came back", lambda: len(back.of(331)) > 20)
    assert web.process.poll() is None and daemon.poll() is None
    assert web.metric("dropped_messages_total") == lost

    # Messages without a signature are refused and counted.
    wait_for("signed estimates", lambda: len(signer.of(331)) > 40)
    assert all(said["signature"] is True for said in signer.heard), "a signature is wrong"
    wait_for("answers to signed questions", lambda: signer.of(111))
    assert signing.metric("refused_messages_total") == 0
    assert all(set(said["fields"]["poseCovariance"]) == {"NaN"} for said in signer.of(331)), "a tilt's error is made up"
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as foreign:
        foreign.sendto(bytes.fromhex("fd090000000101000000036e339c4c9ef8a9a8a4dc"), ("127.0.0.1", signing.mavlink))
    wait_for("the refusal", lambda: signing.metric("refused_messages_total") == 1)
    # It came from another address, to which answers go: the next one of the listener brings them back.
    heard = len(signer.heard)
    wait_for("more of them", lambda: len(signer.heard) > heard + 20)
    assert signing.process.poll() is None and emulator.poll() is None

    # No estimates: none goes out, and that is said.
    daemon.terminate()
    assert daemon.wait(60) == 0
    wait_for("the end of positions", lambda: web.metric("position") == 0)
    wait_for("its text", lambda: any("sends no position: no estimate comes from navcald" in text for _, text in joined_texts(back.of(253))[-2:]))
    ended, beats = len(back.of(331)) + len(back.of(232)), len(back.of(0))
    wait_for("heartbeats without it", lambda: len(back.of(0)) > beats + 2)
    assert len(back.of(331)) + len(back.of(232)) == ended, "a position is repeated"
    web.process.terminate()
    assert web.process.wait(60) == 0
    assert check_fields(listener.heard + back.heard, stand.navs) > 0
    assert not any("bad" in said for said in signer.heard)
    print(f"{len(signer.heard)} signed frames, all good")


with tempfile.TemporaryDirectory() as temporary:
    test = Stand(temporary)
    try:
        run(test)
    except BaseException:
        for log in sorted(test.folder.glob("*.log")):
            print(f"--- {log.name}\n{log.read_text()[-3000:]}")
        raise
    finally:
        for running in test.processes:
            if running.poll() is None:
                running.kill()
                running.wait()
