# SPDX-License-Identifier: Apache-2.0
"""Black-box rig of the serial benchmarks: pseudo-terminals, a daemon, a TCP client. Python's standard library only.

A record is written into the master of a pty; its latency ends when the line with its key comes out of the socket.
Everything runs in one thread, so that the rig costs all daemons alike.
"""
import json
import os
import re
import select
import shutil
import socket
import subprocess
import sys
import tempfile
import termios
import time
import tty

NS = 1_000_000_000
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def navcald_binary():
    found = os.environ.get("NAVCALD") or os.path.join(ROOT, "build", "release", "daemon", "navcald")
    if not os.path.exists(found):
        sys.exit(f"{found}: not there; build it (cmake --preset release && cmake --build build/release) or set NAVCALD")
    return found


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


def sentence(body):
    checksum = 0
    for c in body.encode():
        checksum ^= c
    return f"${body}*{checksum:02X}\r\n".encode()


def compass_record(i):
    """One compass sentence whose heading is its key: unique over 36000 records."""
    heading = f"{(i % 36000) / 100:.2f}"
    return sentence(f"PTNTHTM,{heading},N,{16 + i % 7}.0,N,-{4 + i % 5}.0,N,64.1,{2454 + i % 9}"), float(heading)


COMPASS_KEY = re.compile(rb'"class":"ATT".*?"heading":([0-9.]+)')


class Pty:
    def __init__(self, folder, name):
        self.link = os.path.join(folder, name)
        self.master, slave = os.openpty()
        tty.setraw(slave)
        attributes = termios.tcgetattr(slave)
        attributes[4] = attributes[5] = termios.B9600
        termios.tcsetattr(slave, termios.TCSANOW, attributes)
        self.slave_name = os.ttyname(slave)
        os.chmod(self.slave_name, 0o666)
        os.close(slave)
        os.set_blocking(self.master, False)
        os.symlink(self.slave_name, self.link)

    def write(self, data):
        try:
            return os.write(self.master, data) == len(data)
        except BlockingIOError:
            return False

    def drain(self):
        try:
            while os.read(self.master, 4096):
                pass
        except OSError:
            pass


class Daemon:
    """A running gpsd or navcald on the given ptys; use with `with`."""

    def __init__(self, kind, ptys, log=True, folder=None, environment=None, log_folder=None):
        self.kind, self.port = kind, free_port()
        self.folder = folder or tempfile.mkdtemp(prefix="navcal-bench-")
        self.log_folder = log_folder or os.path.join(self.folder, "log")
        if kind == "gpsd":
            command = ["gpsd", "-N", "-n", "-S", str(self.port)] + [p.link for p in ptys]
        else:
            command = [navcald_binary(), "--config", self.write_config(ptys, log)]
        self.errors = open(os.path.join(self.folder, f"{kind}.err"), "wb")
        self.started_ns = time.monotonic_ns()
        self.start(command, environment or {})

    def start(self, command, environment):
        self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=self.errors, stderr=self.errors,
                                        env={**os.environ, **environment})

    def write_config(self, ptys, log):
        os.makedirs(self.log_folder, exist_ok=True)
        lines = ["[log]", f"enabled = {str(log).lower()}", f'directory = "{self.log_folder}"', "free_floor_MB = 1",
                 "[status]", f"port = {self.port}", "[control]", f'socket = "{self.folder}/control"']
        for p in ptys:
            lines += [f"[port.{os.path.basename(p.link)}]", 'protocol = "nmea"', f'path = "{p.link}"', "baud = 115200"]
        path = os.path.join(self.folder, "navcald.toml")
        with open(path, "w") as f:
            f.write("\n".join(lines) + "\n")
        return path

    def connect(self, receive_buffer=None, timeout_s=15):
        end = time.monotonic() + timeout_s
        while True:
            s = socket.socket()
            if receive_buffer:
                s.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
            try:
                s.connect(("127.0.0.1", self.port))
                break
            except ConnectionRefusedError:
                s.close()
                if time.monotonic() > end or self.process.poll() is not None:
                    sys.exit(f"{self.kind} does not listen: see {self.errors.name}")
                time.sleep(0.002)
        s.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        s.sendall(b'?WATCH={"enable":true,"json":true}\n')
        # What is written before the daemon has heard of us would be counted against it.
        s.settimeout(timeout_s)
        answer = b""
        while b'"class":"WATCH"' not in answer:
            answer += s.recv(65536)
        s.setblocking(False)
        return s

    def usage(self):
        """CPU in ns and voluntary switches over all threads; resident memory in KiB."""
        cpu = switches = 0
        pid = self.process.pid
        for task in os.listdir(f"/proc/{pid}/task"):
            with open(f"/proc/{pid}/task/{task}/schedstat") as f:
                cpu += int(f.read().split()[0])
            with open(f"/proc/{pid}/task/{task}/status") as f:
                switches += int(re.search(r"^voluntary_ctxt_switches:\s+(\d+)", f.read(), re.M).group(1))
        with open(f"/proc/{pid}/status") as f:
            resident = int(re.search(r"^VmRSS:\s+(\d+)", f.read(), re.M).group(1))
        return {"cpu_ns": cpu, "switches": switches, "resident_KiB": resident}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.errors.close()
        if self.folder.startswith(tempfile.gettempdir()):
            shutil.rmtree(self.folder, ignore_errors=True)


class Client:
    """Remembers when the line with each key arrived."""

    def __init__(self, sock, key=COMPASS_KEY):
        self.sock, self.key, self.rest, self.seen, self.lines = sock, key, b"", {}, 0

    def pump(self):
        while True:
            try:
                data = self.sock.recv(65536)
            except (BlockingIOError, ConnectionError):
                return
            now = time.monotonic_ns()
            if not data:
                return
            *lines, self.rest = (self.rest + data).split(b"\n")
            self.lines += len(lines)
            for line in lines:
                found = self.key.search(line)
                if found:
                    self.seen.setdefault(round(float(found.group(1)), 2), now)


def feed(pty, client, rate, records, first=0, tail_s=0.5, on_record=None):
    """Writes `records` at `rate` per second; returns {key: time of writing} and how many did not fit."""
    return feed_in_turn([(pty, client)], rate, records, first, tail_s, on_record)[0]


def feed_in_turn(pairs, rate, records, first=0, tail_s=0.5, on_record=None):
    """Each pair of pty and client gets `records` at `rate` per second, one after the other; a list of what feed() returns."""
    results, period = [[{}, 0] for _ in pairs], int(NS / rate / len(pairs))
    clients = [client for _, client in pairs]
    poll = select.poll()
    for client in clients:
        poll.register(client.sock, select.POLLIN)
    due = time.monotonic_ns()
    for i in range(first * len(pairs), (first + records) * len(pairs)):
        while (left := due - time.monotonic_ns()) > 0:
            # poll() counts in milliseconds; the last part of the wait is spent asking.
            if poll.poll(left // 1_000_000):
                pump_all(clients)
        record, turn = divmod(i, len(pairs))
        data, key = compass_record(record)
        now = time.monotonic_ns()
        if pairs[turn][0].write(data):
            results[turn][0][key] = now
        else:
            results[turn][1] += 1
        due = max(due + period, time.monotonic_ns() - period)
        if on_record:
            on_record(record)
    end = time.monotonic_ns() + int(tail_s * NS)
    while time.monotonic_ns() < end:
        if poll.poll(20):
            pump_all(clients)
    for pty, _ in pairs:
        pty.drain()
    return [tuple(r) for r in results]


def pump_all(clients):
    for client in clients:
        client.pump()


def warm_up(pty, client, limit_s=30):
    """Feeds until records are answered; returns the index to go on with and the time to the first answer."""
    begin, i = time.monotonic_ns(), 30000
    while time.monotonic_ns() - begin < limit_s * NS:
        pty.write(compass_record(i)[0])
        i += 1
        for _ in range(10):
            select.select([client.sock], [], [], 0.01)
            client.pump()
            if client.seen:
                return i, (min(client.seen.values()) - begin) / NS
    sys.exit("no record was answered")


def latencies_us(sent, client):
    return sorted((client.seen[k] - t) / 1000 for k, t in sent.items() if k in client.seen and client.seen[k] >= t)


def quantile(values, share):
    return values[min(len(values) - 1, int(share * len(values)))] if values else float("nan")


def median(values):
    return quantile(sorted(values), 0.5)


def machine():
    with open("/proc/loadavg") as f:
        return json.dumps({"cpus": os.cpu_count(), "load": float(f.read().split()[0]), "kernel": os.uname().release})
