# SPDX-License-Identifier: Apache-2.0
"""`navcal emulate` with its console, and the settings of a navcald at its other end."""
import os
import subprocess

import serial_rig as rig

PORTS = {"compass": ("tcm2", 38400), "imu": ("imu-card", 57600), "gps": ("oncore", 9600), "motor": ("motor-card", 19200)}


def navcal_binary():
    return os.path.join(os.path.dirname(os.path.dirname(rig.navcald_binary())), "cli", "navcal")


class Emulator:
    def __init__(self, folder, seed):
        self.folder = os.path.join(folder, "devices")
        command = [navcal_binary(), "emulate", "--dir", self.folder, "--seed", str(seed), "--compass-baud", "38400"]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                        text=True)
        while "ready" not in (line := self.process.stdout.readline()):
            if not line:
                raise SystemExit("navcal emulate ended")

    def tell(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def link(self, port):
        return os.path.join(self.folder, port)

    def stop(self):
        self.process.terminate()
        self.process.wait()


class VehicleDaemon(rig.Daemon):
    """navcald with the vehicle's own configuration, its ports at `folder`/<name>."""

    settings = {}

    def write_config(self, ptys, log):
        os.makedirs(self.log_folder, exist_ok=True)
        with open(os.path.join(rig.ROOT, "config", "navcald.toml")) as f:
            text = f.read()
        for name in PORTS:
            text = text.replace(f'udev_name = "/dev/navcal/{name}"', f'path = "{self.folder}/{name}"')
        settings = {"log.directory": f'"{self.log_folder}"', "status.port": str(self.port), "log.free_floor_MB": "1",
                    "control.socket": f'"{self.folder}/control"', **self.settings}
        for key, value in settings.items():
            table, _, name = key.partition(".")
            begin = text.index(f"\n[{table}]\n")
            at = text.index(f"\n{name} = ", begin) + 1
            text = text[:at] + f"{name} = {value}" + text[text.index("\n", at):]
        path = os.path.join(self.folder, "navcald.toml")
        with open(path, "w") as f:
            f.write(text)
        return path
