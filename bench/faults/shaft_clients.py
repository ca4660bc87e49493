# SPDX-License-Identifier: Apache-2.0
"""Controllers and other clients of navcald, each a process of its own that dies with the case."""
import ctypes
import json
import mmap
import os
import random
import signal
import socket
import sys
import time

DRIVE, HANG, REFUSED, FLOOD, LEASES = range(5)
DONE, NOT_DONE = 1, 2
FLOOD_LINES = 20
LIBC, PR_SET_PDEATHSIG = ctypes.CDLL(None), 1


def die_with(parent):
    LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != parent:
        os._exit(1)  # it was faster


def shared_words():
    return memoryview(mmap.mmap(-1, 64)).cast("q")


class Driver:
    """A controller. Its shaft speed tells its orders from others'; shared words: its mode, and how many orders it gave."""

    def __init__(self, name, number, priority=1, mode=DRIVE, first_at=0.0, least_s=0.2):
        r = random.Random(f"{name}/{number}")
        self.rpm, self.priority, self.first_at = 100 + 10 * number, priority, first_at
        self.timeout_s = round(r.uniform(least_s, 2), 3)
        self.rate_Hz = r.uniform(max(3, 3 / self.timeout_s), 30)
        self.seen, self.dead_at, self.is_stopped = 0, None, False
        self.shared = shared_words()
        self.shared[0] = mode

    def is_driving(self):
        return self.dead_at is None and not self.is_stopped and self.shared[0] == DRIVE and self.priority == 1


def fork(work, *arguments):
    parent, pid = os.getpid(), os.fork()
    if pid:
        return pid
    try:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        die_with(parent)
        work(*arguments)
    except BaseException as error:
        print(f"{work.__name__}: {error!r}", file=sys.stderr, flush=True)
    os._exit(1)


def connected(path):
    s = socket.socket(socket.AF_UNIX)
    s.connect(path)
    return s, s.makefile("rw")


def ask(lines, **request):
    lines.write(json.dumps(request) + "\n")
    lines.flush()
    return json.loads(lines.readline())


def controller(path, driver):
    """Takes a lease and gives orders at its rate, in the mode that it is told; connects again for ever."""
    os.closerange(3, 256)  # an operator's keyboard among them
    while True:
        try:
            drive(*connected(path), driver)
        except (OSError, ValueError):
            time.sleep(0.05)


def drive(s, lines, driver):
    def lease():
        return ask(lines, command="motor.lease", holder=f"controller {driver.rpm}", priority=driver.priority,
                   timeout_s=driver.timeout_s).get("lease", "none")

    def order(rpm):
        return {"command": "motor.order", "lease": token, "shaft_rpm": rpm, "fins_deg": [0, 0, 0]}

    token, shared, turn = lease(), driver.shared, 0
    time.sleep(max(0, driver.first_at - time.monotonic() - 0.003))
    while time.monotonic() < driver.first_at:
        pass
    while True:
        turn += 1
        if shared[0] == FLOOD:
            shared[1] += FLOOD_LINES
            s.sendall(FLOOD_LINES * (json.dumps(order(driver.rpm)) + "\n").encode())
            try:
                s.recv(1 << 20, socket.MSG_DONTWAIT)
            except BlockingIOError:
                pass
            continue
        if shared[0] == DRIVE:
            shared[1] += 1
            if not ask(lines, **order(driver.rpm))["ok"]:
                token = lease()
        elif shared[0] == REFUSED:
            ask(lines, **order(float("nan") if turn % 2 else 99999))
            token = lease()
        elif shared[0] == LEASES:
            token = lease()
        time.sleep(1 / driver.rate_Hz)


def stopper(path, shared):
    """STOP on a connection of its own. Shared words: when it was asked for, and the result."""
    try:
        s, lines = connected(path)
        s.settimeout(8)
        shared[0] = time.monotonic_ns()
        shared[1] = DONE if ask(lines, command="motor.stop", by="campaign").get("ok") else NOT_DONE
    except (OSError, ValueError):
        shared[1] = NOT_DONE


def operator(program, port, key, timeout_s, keyboard):
    os.dup2(keyboard, 0)
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    os.dup2(1, 2)
    os.execv(program, [program, "remote", f"tcp:127.0.0.1:{port}", "--key-file", key, "--lease-timeout", str(timeout_s)])


def idler(path, count):
    kept = [connected(path) for _ in range(count)]
    signal.pause()
    del kept


def reader_of_nothing(port, count, seconds):
    kept, end = [socket.create_connection(("127.0.0.1", port)) for _ in range(count)], time.monotonic() + seconds
    while time.monotonic() < end:
        for s in kept:
            try:
                s.send(b"?RECORDS;\n" * 50, socket.MSG_DONTWAIT)
            except OSError:
                pass  # navcald takes no more, or has closed it
        time.sleep(0.002)
