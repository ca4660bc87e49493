# SPDX-License-Identifier: Apache-2.0
"""A disk that is full, that turns read-only, that hangs, that fails: what navcald says and does, and what the log holds."""
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time

import serial_rig as rig
from faults import arguments
from faults.kill_part import CardDaemon, Cycle, imu_frame
from faults.log_bytes import Logs, Received, logs_in
from faults.watcher import Watcher

NS = rig.NS
RATE_HZ = 100
BEFORE_S, DURING_S, AFTER_S = 2, 6, 4
LEFT_FREE_KB = 400
SHIMS = os.path.join(rig.ROOT, "build", "bench", "bench")


def add(commands):
    arguments.common(commands, "storage", "full, read-only, hanging and failing disks (root, bench build)")


def command(a):
    return f"bench/reliability storage --seed {a.seed}"


class Disk:
    """A loop device with ext4 of 48 MB at `folder`/log, which goes read-only when its file system finds an error."""

    environment = {}
    lasting = False  # the fault does not end by itself

    def __init__(self, folder):
        self.folder, self.mount = folder, os.path.join(folder, "log")
        self.image = os.path.join(folder, "image")
        with open(self.image, "wb") as f:
            f.truncate(48 << 20)
        self.call("mkfs.ext4", "-q", "-F", "-m", "0", "-E", "lazy_itable_init=0,lazy_journal_init=0", self.image)
        os.makedirs(self.mount)
        self.call("mount", "-o", "loop,noatime,errors=remount-ro", self.image, self.mount)

    @staticmethod
    def call(*command):
        subprocess.run(command, check=True, capture_output=True)

    def begin(self):
        pass

    def end(self):
        pass

    def unmount(self):
        self.call("umount", self.mount)

    def check(self):
        """Exit status of fsck in pretence: 0 when the file system is clean."""
        return subprocess.run(["fsck.ext4", "-n", "-f", self.image], capture_output=True).returncode


class Full(Disk):
    name = "full for 6 s"

    def __init__(self, folder):
        super().__init__(folder)
        self.ballast = os.path.join(self.mount, "ballast")
        free = os.statvfs(self.mount)
        with open(self.ballast, "wb") as f:
            os.posix_fallocate(f.fileno(), 0, free.f_bavail * free.f_frsize - LEFT_FREE_KB * 1024)

    def end(self):
        os.unlink(self.ballast)


class ReadOnly(Disk):
    name = "file system turns read-only"
    lasting = True

    def begin(self):
        device = os.path.basename(subprocess.run(["losetup", "-n", "-O", "NAME", "-j", self.image], check=True,
                                                 capture_output=True, text=True).stdout.strip())
        with open(f"/sys/fs/ext4/{device}/trigger_fs_error", "w") as f:
            f.write("1")


class Hanging(Disk):
    name = "hangs 2 s at a sync, every 3 s"
    environment = {"LD_PRELOAD": f"{SHIMS}/libstalling_disk.so", "STALL_SYNC_MS": "2000", "STALL_EVERY_S": "3"}


class Failing(Disk):
    def __init__(self, folder):
        super().__init__(folder)
        self.flag = os.path.join(folder, "failing")
        self.environment = {"LD_PRELOAD": f"{SHIMS}/libfailing_disk.so", self.variable: self.flag}

    def begin(self):
        open(self.flag, "w").close()

    def end(self):
        os.unlink(self.flag)


class FailingWrites(Failing):
    name, variable = "every write fails (EIO) for 6 s", "FAIL_WRITES_WHILE"


class FailingSyncs(Failing):
    name, variable = "every sync fails (EIO) for 6 s", "FAIL_SYNCS_WHILE"


class NoFloor(CardDaemon):
    free_floor_MB = 0  # writes up to the last byte


class Run:
    """Two cards at a navcald whose disk has its fault in the middle."""

    def __init__(self, kind):
        self.folder = tempfile.mkdtemp(prefix="navcal-reliability-")
        self.disk = kind(self.folder)
        self.written, self.k = {"a": [], "b": []}, 0
        self.states, self.last_log = [], {}

    def feed(self, ptys, watcher, seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for p in ptys:
                data = imu_frame(self.k)
                if p.write(data):
                    self.written[os.path.basename(p.link)].append((time.monotonic_ns(), data))
                self.k += 1
            watcher.pump()
            self.note(watcher)
            time.sleep(1 / RATE_HZ)

    def note(self, watcher):
        if watcher.health is None:
            return
        log = watcher.health["log"]
        if not self.states or self.states[-1][0] != log["state"]:
            self.states.append((log["state"], log["reason"]))
        self.last_log = log

    def go(self):
        disk = self.disk
        ptys = [rig.Pty(self.folder, name) for name in self.written]
        daemon = NoFloor("navcald", ptys, folder=self.folder, environment=disk.environment)
        try:
            watcher = Watcher(daemon.connect())
            Cycle.wait_until_open(ptys)
            self.feed(ptys, watcher, BEFORE_S)
            disk.begin()
            self.feed(ptys, watcher, DURING_S)
            if not disk.lasting:
                disk.end()
            self.feed(ptys, watcher, AFTER_S)
            end = time.monotonic() + 1
            while time.monotonic() < end:
                watcher.pump()
                time.sleep(0.02)
            self.note(watcher)
            self.heard = {name: len(times) for name, times in watcher.heard.items()}
            begun = time.monotonic()
            daemon.process.terminate()
            self.status = daemon.process.wait(60)
            self.stop_s = time.monotonic() - begun
        finally:
            if daemon.process.poll() is None:
                daemon.process.kill()
                daemon.process.wait()
            daemon.errors.close()
            for p in ptys:
                os.close(p.master)
        return self.judge()

    def judge(self):
        logs = Logs(logs_in(self.disk.mount))
        written = missing = 0
        problems = []
        for name, writes in self.written.items():
            given = b"".join(data for _, data in writes)
            logged = bytes(logs.ports.get(name, Received()).data)
            written += len(given)
            missing += len(given) - len(logged)
            if not given.startswith(logged):
                problems.append("the log differs from what was written")
            if self.heard.get(name, 0) < len(writes):
                problems.append(f"port {name}: {self.heard.get(name, 0)} samples of {len(writes)} heard")
        if missing and not self.disk.lasting:
            problems.append(f"{missing} bytes are not in the log")
        if self.disk.lasting and self.states[-1][0] == "writing":
            problems.append("the daemon does not say that the log is not written")
        if self.status != 0:
            problems.append(f"navcald ended with {self.status}")
        self.disk.unmount()
        result = {"written": written, "missing": missing, "said": [f"{s}: {r}" if r else s for s, r in self.states],
                  "dropped_records": self.last_log.get("lost"), "stop_s": round(self.stop_s, 2), "fsck": self.disk.check()}
        if not problems:
            shutil.rmtree(self.folder, ignore_errors=True)
        else:
            print(f"kept: {self.folder}", file=sys.stderr)
        return result, problems


KINDS = (Full, ReadOnly, Hanging, FailingWrites, FailingSyncs)


def run(a):
    if os.geteuid() != 0:
        arguments.skip("only root can mount")
    for shim in ("stalling", "failing"):
        if not os.path.exists(f"{SHIMS}/lib{shim}_disk.so"):
            arguments.skip(f"{SHIMS}/lib{shim}_disk.so is not there: cmake --preset bench && cmake --build build/bench")
    random.seed(a.seed)
    kinds, problems = {}, []
    for kind in KINDS:
        kinds[kind.name], found = Run(kind).go()
        problems += [f"{kind.name}: {p}" for p in found]
    return {"kinds": kinds, "seconds": [BEFORE_S, DURING_S, AFTER_S]}, problems
