#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`navcal ports send-calibration` against an autopilot that node-mavlink plays (autopilot.mjs).

usage: check_send_calibration.py NAVCAL
"""

import contextlib
import json
import os
import pathlib
import pty
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import tty

NAVCAL = os.path.abspath(sys.argv[1])
AUTOPILOT = pathlib.Path(__file__).with_name("autopilot.mjs")
FLOAT, INT8, INT32 = 9, 2, 6
HAS = {"COMPASS_OFS_X": [-50.5, FLOAT], "COMPASS_OFS_Y": [12.25, FLOAT], "COMPASS_OFS_Z": [0, FLOAT], "COMPASS_DIA_X": [1, FLOAT],
       "COMPASS_DIA_Y": [1, FLOAT], "COMPASS_DIA_Z": [1, FLOAT], "COMPASS_MOTCT": [0, INT8]}
FILE = "# On readings held out 9.0 -> 0.5 %\nCOMPASS_OFS_X,31.2345\nCOMPASS_OFS_Y,-8\nCOMPASS_DIA_X,1.05\nCOMPASS_MOTCT,2\n"
NEW = {**{name: value for name, (value, _) in HAS.items()}, "COMPASS_OFS_X": 31.2345, "COMPASS_OFS_Y": -8, "COMPASS_DIA_X": 1.05,
       "COMPASS_MOTCT": 2}


class Vehicle:
    """The autopilot, in a folder of its own; `truth` is known at its end."""

    def __init__(self, **options):
        options.setdefault("parameters", HAS)
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        self.link = f"udp:127.0.0.1:{self.port}"
        self.options = options

    def __enter__(self):
        self.process = subprocess.Popen(["node", AUTOPILOT, str(self.port), "600", self.folder / "truth.json",
                                         json.dumps(self.options)])
        return self

    def __exit__(self, *_):
        self.process.terminate()
        assert self.process.wait(60) == 0
        truth = json.loads((self.folder / "truth.json").read_text())
        assert truth["bad"] == 0
        self.sets = [came["parameter"] for came in truth["came"] if came["id"] == 23]
        assert all((came["system"], came["component"]) == (255, 25) for came in truth["came"]), truth["came"]
        self.values = {name: value for name, (value, _) in truth["parameters"].items()}

    def command(self, text, *more, name="compass.param"):
        if text is not None:
            (self.folder / name).write_text(text)
        return [NAVCAL, "ports", "send-calibration", self.link, "--parameters", name, *more]

    def run(self, text, *more, **named):
        ended = subprocess.run(self.command(text, *more, **named), cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                               text=True, timeout=300)
        return ended.returncode, ended.stdout, ended.stderr

    def saved(self):
        return sorted(file.name for file in self.folder.glob("before-*"))


def close(found, expected):
    assert found.keys() == expected.keys() and all(abs(found[name] - expected[name]) < 1e-5 for name in expected), (found, expected)


def answered(vehicle, text, answer):
    """Status and output of the command at a terminal, whose operator answers its question."""
    us, them = pty.openpty()
    process = subprocess.Popen(vehicle.command(text), cwd=vehicle.folder, stdin=them, stdout=them, stderr=them)
    os.close(them)
    shown = b""
    with contextlib.suppress(OSError):  # the other end is closed
        while part := os.read(us, 4096):
            shown += part
            if shown.endswith(b"[y/N] "):
                time.sleep(2.5)  # heartbeats come meanwhile
                os.write(us, answer)
    os.close(us)
    return process.wait(60), shown.decode()


def shows_writes_and_takes_back():
    with Vehicle() as vehicle:
        status, shown = answered(vehicle, FILE, b"y\n")
        assert status == 0, shown
        for words in ("9.0 -> 0.5 %", "system 1, not armed", "-50.5 -> 31.2345", "1 -> 1.05", "0 -> 2"):
            assert words in shown, shown
        saved = vehicle.saved()
        assert len(saved) == 1, saved
        status, out, err = vehicle.run(FILE, "--yes")
        assert (status, "has these values" in out, vehicle.saved()) == (0, True, saved), (out, err)
    close(vehicle.values, NEW)
    assert vehicle.sets == ["COMPASS_OFS_X", "COMPASS_OFS_Y", "COMPASS_DIA_X", "COMPASS_MOTCT"]
    with Vehicle(parameters={name: [value, HAS[name][1]] for name, value in NEW.items()}) as again:
        status, out, err = again.run((vehicle.folder / saved[0]).read_text(), "--yes")
        assert status == 0, (out, err)
    close(again.values, {name: value for name, (value, _) in HAS.items()})


def writes_nothing(options, text, expected_status, *words, more=("--yes",)):
    with Vehicle(**options) as vehicle:
        status, out, err = vehicle.run(text, *more)
        assert status == expected_status, (out, err)
        for word in words:
            assert word in err, (word, err)
        assert vehicle.saved() == []
    assert vehicle.sets == [], vehicle.sets


def refuses():
    writes_nothing({}, FILE, 2, "no terminal", "nothing was written", more=())
    writes_nothing({"armed": True}, FILE, 1, "is armed", "nothing was written")
    writes_nothing({}, FILE + "COMPASS_OFS9_X,1\nCOMPASS_OFS8_X,1\n", 1, "COMPASS_OFS9_X COMPASS_OFS8_X;", "nothing was written")
    writes_nothing({"parameters": {}}, FILE, 1, "does not tell: COMPASS_OFS_X;")
    no_diagonal = {**HAS, **{f"COMPASS_DIA_{axis}": [0, FLOAT] for axis in "XYZ"}}
    writes_nothing({"parameters": no_diagonal}, FILE, 1, "COMPASS_DIA is 0", "nothing was written")
    for line in ("ARMING_CHECK,0", "COMPASS_OFS_X", "COMPASS_OFS_X,one", "COMPASS_OFS_X,nan", "COMPASS_OFS_X,1,2", "1\t1\tCOMPASS_OFS_X"):
        status, _, err = Vehicle().run(FILE + line + "\n", "--yes")
        assert status == 3 and "compass.param: is no value of a compass" in err and line.split()[0].split(",")[0] in err, err
    with Vehicle() as vehicle:
        status, shown = answered(vehicle, FILE, b"n\n")
        assert status == 1 and "not confirmed; nothing was written" in shown, shown
    assert vehicle.sets == []
    with Vehicle(arms_after_reads=4) as vehicle:  # while the operator thinks
        status, shown = answered(vehicle, FILE, b"y\n")
        assert status == 1 and "is armed; nothing was written" in shown and vehicle.saved() == [], shown
    assert vehicle.sets == []


def names_a_silent_link():
    vehicle = Vehicle()
    status, _, err = vehicle.run(FILE, "--yes")
    assert status == 1 and f"{vehicle.link}: no heartbeat of an autopilot within 10 s" in err, err
    vehicle.link = "tcp:127.0.0.1:1"
    status, _, err = vehicle.run(FILE, "--yes")
    assert status == 1 and "Connection refused" in err, err
    vehicle.link = "nowhere"
    status, _, err = vehicle.run(FILE, "--yes")
    assert status == 2 and "nowhere: is no" in err, err


def relayed(vehicle, reads, writes):
    """Carries bytes between the autopilot's datagrams and a stream, until the stream ends."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as datagrams, contextlib.suppress(OSError):
        datagrams.bind(("127.0.0.1", vehicle.port))
        datagrams.settimeout(0.01)
        peer = None
        while True:
            with contextlib.suppress(TimeoutError):
                data, peer = datagrams.recvfrom(65536)
                writes(data)
            with contextlib.suppress(BlockingIOError):
                data = reads(65536)
                if not data:
                    return
                if peer:
                    datagrams.sendto(data, peer)


def goes_by_tcp_and_by_a_serial_line():
    with Vehicle() as vehicle, socket.create_server(("127.0.0.1", 0)) as server:
        vehicle.link = f"tcp:127.0.0.1:{server.getsockname()[1]}"

        def serve():
            stream, _ = server.accept()
            with stream:
                stream.setblocking(False)
                relayed(vehicle, stream.recv, stream.sendall)

        threading.Thread(target=serve, daemon=True).start()
        status, out, err = vehicle.run(FILE, "--yes")
        assert status == 0, (out, err)
    close(vehicle.values, NEW)
    with Vehicle() as vehicle:
        us, them = pty.openpty()
        tty.setraw(them)
        os.set_blocking(us, False)
        vehicle.link = os.ttyname(them)
        threading.Thread(target=relayed, daemon=True,
                         args=(vehicle, lambda size: os.read(us, size), lambda data: os.write(us, data))).start()
        status, out, err = vehicle.run(FILE, "--yes", "--baud", "57600")
        assert status == 0, (out, err)
    close(vehicle.values, NEW)


def is_not_stopped_by_losses():
    with Vehicle(loss=0.3) as vehicle:
        status, out, err = vehicle.run(FILE, "--yes")
        assert status == 0, (out, err)
    close(vehicle.values, NEW)


def names_what_was_not_taken():
    with Vehicle(most={"COMPASS_OFS_X": 20}) as vehicle:
        status, out, err = vehicle.run(FILE, "--yes")
        assert status == 1 and "3 of 4 values were taken" in err, (out, err)
        assert "COMPASS_OFS_X    not taken: it is 20\n" in out and "COMPASS_MOTCT    taken\n" in out, out
    close(vehicle.values, {**NEW, "COMPASS_OFS_X": 20})
    with Vehicle(arms_after=1, loss=0.2) as vehicle:
        long = FILE + "".join(f"COMPASS_OFS_Z,{value}\n" for value in range(1, 40))
        status, out, err = vehicle.run(long, "--yes")
        assert status == 1 and "the vehicle is armed" in err and "not sent" in out, (out, err)


def says_what_an_interruption_leaves():
    with Vehicle(deaf_after=2) as vehicle:
        process = subprocess.Popen(vehicle.command(FILE, "--yes"), cwd=vehicle.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        time.sleep(6)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
        assert process.returncode == 1 and "1 of 4 values were taken: interrupted" in err, (out, err)
        assert out.endswith("COMPASS_OFS_X    taken\nCOMPASS_OFS_Y    sent; it may have been taken or not\n"
                            "COMPASS_DIA_X    not sent\nCOMPASS_MOTCT    not sent\n"), out
        assert len(vehicle.saved()) == 1


def writes_to_px4():
    has = {"CAL_MAG0_XOFF": [0.125, FLOAT], "CAL_MAG0_XSCALE": [1, FLOAT], "CAL_MAG_COMP_TYP": [-1, INT32]}
    lines = "1\t1\tCAL_MAG0_XOFF\t-0.25\t9\n1\t1\tCAL_MAG0_XSCALE\t1.0625\t9\n1\t1\tCAL_MAG_COMP_TYP\t70000\t6\n"
    with Vehicle(parameters=has, px4=True) as vehicle:
        status, out, err = vehicle.run(lines, "--yes", name="compass.params")
        assert status == 0 and "PX4, system 1" in out, (out, err)
        saved = (vehicle.folder / vehicle.saved()[0]).read_text()
    close(vehicle.values, {"CAL_MAG0_XOFF": -0.25, "CAL_MAG0_XSCALE": 1.0625, "CAL_MAG_COMP_TYP": 70000})
    assert saved == "CAL_MAG0_XOFF,0.125\nCAL_MAG0_XSCALE,1\nCAL_MAG_COMP_TYP,-1\n", saved


for case in (shows_writes_and_takes_back, refuses, names_a_silent_link, goes_by_tcp_and_by_a_serial_line,
             is_not_stopped_by_losses, names_what_was_not_taken, says_what_an_interruption_leaves, writes_to_px4):
    began = time.monotonic()
    case()
    print(f"{case.__name__}: {time.monotonic() - began:.1f} s", flush=True)
