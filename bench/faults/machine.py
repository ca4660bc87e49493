# SPDX-License-Identifier: Apache-2.0
"""A Debian machine in qemu: its root made by debootstrap, its image, its console, its two UARTs."""
import glob
import os
import re
import shutil
import socket
import subprocess

import serial_rig as rig

FOLDER = os.path.join(rig.ROOT, "build", "power_cut")
ROOT = os.path.join(FOLDER, "root")
PACKAGES = "systemd-sysv,udev,linux-image-amd64,libserialport0,libspdlog1.10,libfmt9,libsystemd0,e2fsprogs,initramfs-tools"
IMAGE_MB = 1200
MODULES = "virtio_pci\nvirtio_blk\next4\n8250\n"
CONFIG = """[log]
directory = "/var/lib/navcal"
free_floor_MB = 1
[port.a]
protocol = "imu-card"
path = "/dev/ttyS1"
baud = 57600
rate_Hz = 20
[port.b]
protocol = "imu-card"
path = "/dev/ttyS2"
baud = 57600
rate_Hz = 20
"""
# Told on the console, for whoever stands at it; the driver reads it there.
REPORT = """[Unit]
After=navcald.service
[Service]
Type=oneshot
ExecStart=/bin/sh /usr/local/bin/report
StandardOutput=file:/dev/ttyS0
[Install]
WantedBy=multi-user.target
"""
SCRIPT = r"""say() { echo "NAVCAL $*"; }
say booted "$(systemctl show -P ActiveState -P SubState -P NotifyAccess navcald | tr '\n' ' ')"
case $(cat /proc/cmdline) in *navcal.look*) ;; *) exit 0 ;; esac
sleep 5
say status "$(systemctl show -P StatusText navcald)"
before=$(systemctl show -P NRestarts navcald)
kill -STOP "$(systemctl show -P MainPID navcald)"
for i in $(seq 60); do
  sleep 1
  after=$(systemctl show -P NRestarts navcald)
  [ "$after" != "$before" ] && break
done
say watchdog "restarts $before $after after $i s"
sleep 3
say again "$(systemctl show -P ActiveState -P Result navcald | tr '\n' ' ')"
say seccomp "$(dmesg | grep -c 'audit.*type=1326' || true)"
say looked
"""


def call(*command, **more):
    return subprocess.run(command, check=True, capture_output=True, text=True, **more).stdout


def make_root():
    """The machine's root, once; then navcal as it is built now."""
    if not os.path.exists(os.path.join(ROOT, "etc", "debian_version")):
        shutil.rmtree(ROOT, ignore_errors=True)
        os.makedirs(FOLDER, exist_ok=True)
        call("debootstrap", "--variant=minbase", f"--include={PACKAGES}", "bookworm", ROOT)
    if not glob.glob(f"{ROOT}/boot/initrd.small"):
        write("etc/initramfs-tools/modules", MODULES)
        write("etc/initramfs-tools/conf.d/small", "MODULES=list\nCOMPRESS=lz4\n")
        version = os.path.basename(glob.glob(f"{ROOT}/lib/modules/*")[0])
        call("chroot", ROOT, "mkinitramfs", "-o", "/boot/initrd.small", version)
    call("cmake", "--install", os.path.dirname(os.path.dirname(rig.navcald_binary())), "--prefix", f"{ROOT}/usr")
    for file in glob.glob(f"{ROOT}/usr/lib/systemd/system/navcald.*") + [f"{ROOT}/usr/lib/tmpfiles.d/navcal.conf"]:
        with open(file) as f:
            text = f.read()
        with open(file, "w") as f:
            f.write(text.replace(f"{ROOT}/usr", "/usr"))
    for library in call("ldd", rig.navcald_binary()).splitlines():
        path = library.split()[2] if "=>" in library else ""
        if path.startswith("/") and not glob.glob(f"{ROOT}/usr/lib/x86_64-linux-gnu/{os.path.basename(path)}"):
            shutil.copy(path, f"{ROOT}/usr/lib/x86_64-linux-gnu/")
    write("etc/navcal/navcald.toml", CONFIG)
    write("etc/fstab", "/dev/vda / ext4 rw,noatime,errors=remount-ro 0 1\n")
    write("etc/hostname", "vehicle\n")
    write("etc/systemd/system/report.service", REPORT)
    write("usr/local/bin/report", SCRIPT)
    call("chroot", ROOT, "systemctl", "enable", "navcald.socket", "navcald.service", "report.service")
    call("chroot", ROOT, "systemctl", "mask", "serial-getty@ttyS0.service", "getty@tty1.service", "apt-daily.timer",
         "apt-daily-upgrade.timer", "dpkg-db-backup.timer", "e2scrub_all.timer", "fstrim.timer", "motd-news.timer")


def write(path, text):
    full = os.path.join(ROOT, path)
    os.makedirs(os.path.dirname(full), exist_ok=True)
    with open(full, "w") as f:
        f.write(text)


class Machine:
    """Off until start(); `uarts` are sockets while it runs."""

    def __init__(self, folder, memory_MB):
        self.folder, self.memory_MB = folder, memory_MB
        self.image, self.console = os.path.join(folder, "image"), os.path.join(folder, "console")
        self.process, self.uarts = None, []
        call("mkfs.ext4", "-q", "-F", "-E", "lazy_itable_init=0,lazy_journal_init=0", "-d", ROOT, self.image, f"{IMAGE_MB}M")

    def start(self, words=""):
        paths = [os.path.join(self.folder, f"uart{i}") for i in (1, 2)]
        command = ["qemu-system-x86_64", "-accel", "tcg", "-m", str(self.memory_MB), "-smp", "1", "-nographic", "-nodefaults",
                   "-no-reboot", "-kernel", glob.glob(f"{ROOT}/boot/vmlinuz-*")[0], "-initrd", f"{ROOT}/boot/initrd.small", "-append",
                   f"root=/dev/vda rw console=ttyS0 quiet mitigations=off {words}", "-drive",
                   f"file={self.image},if=virtio,format=raw,cache=writeback", "-serial", f"file:{self.console}"]
        for i, path in enumerate(paths):
            command += ["-chardev", f"socket,id=u{i},path={path},server=on,wait=off", "-serial", f"chardev:u{i}"]
        for path in paths:
            if os.path.exists(path):
                os.unlink(path)  # of the run before: it would be taken for the new one
        open(self.console, "w").close()
        with open(os.path.join(self.folder, "qemu.err"), "ab") as errors:
            self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=errors, stderr=errors)
        self.paths = paths

    def connect(self):
        """To both UARTs."""
        for path in self.paths:
            s = socket.socket(socket.AF_UNIX)
            s.settimeout(30)
            s.connect(path)
            self.uarts.append(s)

    def said(self, what):
        with open(self.console, errors="replace") as f:
            # The terminal's own control characters may stand before it.
            found = re.search(f"NAVCAL ({what}.*)\n", f.read())
        return found.group(1).strip() if found else None

    def cut(self):
        if self.process:
            self.process.kill()
            self.process.wait()
        for s in self.uarts:
            s.close()
        self.uarts = []

    def check(self):
        """As at boot: the journal is replayed; the exit status of fsck (0 and 1 are good, 4 is damage left)."""
        subprocess.run(["e2fsck", "-p", self.image], capture_output=True)
        return subprocess.run(["e2fsck", "-f", "-n", self.image], capture_output=True).returncode

    def take_logs(self, to):
        shutil.rmtree(to, ignore_errors=True)
        os.makedirs(to)
        call("debugfs", "-R", f"rdump /var/lib/navcal {to}", self.image)
        return os.path.join(to, "navcal")
