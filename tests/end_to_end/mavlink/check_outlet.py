#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`navcal-web --mavlink` beside navcald on emulated instruments: what node-mavlink decodes (listener.mjs) is what navcald said at
the same stamp, field by field, and a peer that goes away disturbs nothing.

usage: check_outlet.py NAVCAL NAVCALD NAVCAL_WEB
"""

import hashlib
import json
import math
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


class Stand:
    def __init__(self, folder):
        self.folder, self.processes, self.navs, self.heard = pathlib.Path(folder), [], {}, []

    def start(self, name, *command):
        with open(self.folder / f"{name}.log", "ab") as log:
            process = subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE if name == "listener" else log, stderr=log,
                                       text=True)
        self.processes.append(process)
        return process

    def navcald(self):
        lines = ['log.enabled = false', f'log.directory = "{self.folder}"', f'status.port = {self.status}', f'control.socket = "{self.folder}/control"',
                 "navigation.interval_s = 0.05"]
        for port, protocol in (("compass", "tcm2"), ("imu", "imu-card"), ("gps", "oncore"), ("motor", "motor-card")):
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

    def web(self, *options):
        self.http = free_port(socket.SOCK_STREAM)
        return self.start("navcal-web", NAVCAL_WEB, "--port", self.http, "--status", f"127.0.0.1:{self.status}", "--mavlink",
                          f"udp:127.0.0.1:{self.mavlink}", *options)

    def listen(self, *key):
        listener = self.start("listener", "node", HERE / "listener.mjs", self.mavlink, *key)
        threading.Thread(target=lambda: [self.heard.append(json.loads(line)) for line in listener.stdout], daemon=True).start()
        return listener

    def metric(self, name):
        with urllib.request.urlopen(f"http://127.0.0.1:{self.http}/metrics", timeout=20) as page:
            for line in page.read().decode().splitlines():
                if line.startswith(name + " "):
                    return float(line.split()[1])
        return None

    def command(self, **request):
        with socket.socket(socket.AF_UNIX) as control:
            control.connect(f"{self.folder}/control")
            control.sendall(json.dumps(request).encode() + b"\n")
            assert json.loads(control.makefile().readline())["ok"]

    def of(self, number):
        return [said for said in self.heard if said.get("id") == number]


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


def check_odometry(said, nav, origin):
    fields = said["fields"]
    assert (fields["frameId"], fields["childId"] if "childId" in fields else fields["childFrameId"]) == (20, 12), fields
    assert (fields["quality"], fields["estimatorType"]) == (0, 0)
    # On the ellipsoid, within a few hundred metres of the origin.
    lat = math.radians(origin[0])
    sine = 1 - 0.00669437999 * math.sin(lat) ** 2
    north = math.radians(nav["lat"] - origin[0]) * 6378137 * (1 - 0.00669437999) / sine ** 1.5
    east = math.radians(nav["lon"] - origin[1]) * 6378137 / math.sqrt(sine) * math.cos(lat)
    near(fields["x"], north, 0.01 + 1e-4 * abs(north))
    near(fields["y"], east, 0.01 + 1e-4 * abs(east))
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


def run(stand):
    stand.status, stand.mavlink = free_port(socket.SOCK_STREAM), free_port(socket.SOCK_DGRAM)
    emulator = stand.start("emulate", NAVCAL, "emulate", "--mission", "survey", "--dir", stand.folder / "ports", "--seed", "5")
    wait_for("the emulated instruments", lambda: "ready" in (stand.folder / "emulate.log").read_text())
    daemon = stand.navcald()
    wait_for("navcald", lambda: socket.create_connection(("127.0.0.1", stand.status)).close() is None)
    threading.Thread(target=stand.watch, daemon=True).start()
    web = stand.web("--mavlink-gps-rate", "5", "--mavlink-tilt-std", TILT_STD_DEG)
    listener = stand.listen()
    wait_for("a position", lambda: stand.of(331))
    wait_for("the metric", lambda: stand.metric("navcal_web_mavlink_position") == 1)
    stand.command(command="event", text=EVENT)
    begin, before = time.monotonic(), len(stand.of(331))
    time.sleep(10)
    rate = (len(stand.of(331)) - before) / (time.monotonic() - begin)
    texts = wait_for("the event", lambda: [text for text in joined_texts(stand.of(253)) if text[1].endswith(EVENT)])
    assert texts == [(6, EVENT)], texts
    wait_for("the last estimates", lambda: int(stand.of(331)[-1]["fields"]["timeUsec"]) <= max(stand.navs))

    # A peer that is stopped, and gone: navcald and the others see nothing of it.
    listener.send_signal(signal.SIGSTOP)
    navs = len(stand.navs)
    wait_for("estimates go on", lambda: len(stand.navs) > navs + 60)
    listener.kill()
    listener.wait()
    navs = len(stand.navs)
    wait_for("estimates go on", lambda: len(stand.navs) > navs + 60)
    heard = len(stand.heard)
    listener = stand.listen()
    wait_for("the peer that came back", lambda: len(stand.heard) > heard + 100)
    assert web.poll() is None and daemon.poll() is None

    assert stand.metric("navcal_web_mavlink_dropped_messages_total") == 0
    web.terminate()
    assert web.wait(60) == 0
    time.sleep(1)
    listener.terminate()
    listener.wait()
    heard = stand.heard
    assert not any("bad" in said for said in heard), "a frame did not decode"
    assert {(said["system"], said["component"]) for said in heard} == {(1, 197)}
    assert all(said["trimmed"] for said in heard)
    first = next(said for said in heard if said.get("id") == 331)
    origin_at = int(first["fields"]["timeUsec"])
    # The first one is at the origin by definition.
    origin = (stand.navs[origin_at]["lat"], stand.navs[origin_at]["lon"])
    known = [check_odometry(said, stand.navs[int(said["fields"]["timeUsec"])], origin) for said in stand.of(331)]
    for said in stand.of(232):
        at = int(said["fields"]["timeUsec"])
        check_gps(said, stand.navs[at], is_north_known=at > origin_at)
    stamps = [said["fields"]["timeUsec"] for said in stand.of(331)]
    assert len(set(stamps)) == len(stamps), "an estimate was sent twice"
    values = {said["fields"]["name"] for said in stand.of(251)}
    assert {"hdg_std", "pos_std", "fix_age"} <= values, values
    beat = stand.of(0)[0]["fields"]
    assert (beat["type"], beat["autopilot"], beat["systemStatus"]) == (18, 8, 4), beat
    # Its clock is that of the stamps.
    clock = stand.of(111)
    assert clock and all(abs(int(said["fields"]["tc1"]) * 1e-9 - time.time()) < 300 for said in clock)
    near(rate, 20, 2)
    print(f"{len(heard)} frames, all decoded: {len(known)} ODOMETRY ({rate:.1f} a second; {sum(known)} with covariance), "
          f"{len(stand.of(232))} GPS_INPUT, {len(stand.of(251))} NAMED_VALUE_FLOAT, {len(stand.of(253))} STATUSTEXT, {len(clock)} TIMESYNC")

    # Signed both ways with a passphrase; messages without a signature are refused and counted.
    key = stand.folder / "key"
    key.write_text(PASSPHRASE + "\n")
    os.chmod(key, 0o644)
    assert stand.web("--mavlink-key-file", key).wait(60) == 1
    assert "chmod 600" in (stand.folder / "navcal-web.log").read_text()
    os.chmod(key, 0o600)
    stand.heard.clear()
    web = stand.web("--mavlink-key-file", key)
    listener = stand.listen(hashlib.sha256(PASSPHRASE.encode()).hexdigest())
    wait_for("signed estimates", lambda: len(stand.of(331)) > 40)
    assert all(said["signature"] is True for said in stand.heard), "a signature is wrong"
    wait_for("answers to signed questions", lambda: stand.of(111))
    assert stand.metric("navcal_web_mavlink_refused_messages_total") == 0
    assert all(set(said["fields"]["poseCovariance"]) == {"NaN"} for said in stand.of(331)), "a tilt's error is made up"
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as foreign:
        foreign.sendto(bytes.fromhex("fd090000000101000000036e339c4c9ef8a9a8a4dc"), ("127.0.0.1", stand.mavlink))
    wait_for("the refusal", lambda: stand.metric("navcal_web_mavlink_refused_messages_total") == 1)
    assert web.poll() is None and emulator.poll() is None
    print(f"{len(stand.heard)} signed frames, all good")

    # No estimates: none goes out, and that is said.
    daemon.terminate()
    assert daemon.wait(60) == 0
    wait_for("the end of positions", lambda: stand.metric("navcal_web_mavlink_position") == 0)
    wait_for("its text", lambda: any("sends no position: no estimate comes from navcald" in text for _, text in joined_texts(stand.of(253))[-2:]))
    ended = len(stand.of(331)) + len(stand.of(232))
    time.sleep(2)
    assert len(stand.of(331)) + len(stand.of(232)) == ended, "a position is repeated"


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
