# SPDX-License-Identifier: Apache-2.0
"""A serial line with somebody in the middle: emulated device - pseudo-terminal - us - pseudo-terminal - navcald.

Every byte that is given to navcald is kept, with the time of the write, one `Life` for each pseudo-terminal.
"""
import bisect
import os
import select
import termios
import time
import tty

import serial_rig as rig

SPEEDS = {4800: termios.B4800, 9600: termios.B9600, 19200: termios.B19200, 38400: termios.B38400,
          57600: termios.B57600, 115200: termios.B115200}


class Life:
    """One pseudo-terminal of a port, from its making until it was hung up."""

    def __init__(self):
        self.begun_ns, self.ended_ns = time.monotonic_ns(), None
        self.data, self.ends, self.times_ns = bytearray(), [], []

    def add(self, data, now_ns):
        self.data += data
        self.ends.append(len(self.data))
        self.times_ns.append(now_ns)

    def written_ns(self, offset):
        """When the byte at `offset` was written."""
        return self.times_ns[bisect.bisect_right(self.ends, offset)]

    def longest_pause_ns(self, begin, end):
        """Between two writes that brought these bytes."""
        first, last = bisect.bisect_right(self.ends, begin), bisect.bisect_right(self.ends, end - 1)
        return max((self.times_ns[i + 1] - self.times_ns[i] for i in range(first, last)), default=0)


class Line:
    def __init__(self, name, protocol, baud, device_link, folder):
        self.name, self.protocol, self.baud, self.folder = name, protocol, baud, folder
        self.device = os.open(device_link, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        tty.setraw(self.device, termios.TCSANOW)
        self.listen_at(baud)
        self.spoil = None           # bytes of the device -> pieces to be written now
        self.spoil_command = None   # bytes of navcald -> bytes for the device
        self.said = bytearray()  # by the device, before anything was spoilt
        self.lives, self.pty = [], None
        self.unheard = self.refused = self.commands = 0
        self.plug()

    def listen_at(self, baud):
        """The device itself answers to a wrong speed with what a UART would make of it."""
        settings = termios.tcgetattr(self.device)
        settings[4] = settings[5] = SPEEDS[baud]
        termios.tcsetattr(self.device, termios.TCSANOW, settings)

    @property
    def link(self):
        return os.path.join(self.folder, self.name)

    def plug(self):
        self.pty = rig.Pty(self.folder, self.name + ".next")
        os.replace(self.link + ".next", self.link)
        self.lives.append(Life())

    def unplug(self):
        os.unlink(self.link)
        os.close(self.pty.master)
        self.lives[-1].ended_ns = time.monotonic_ns()
        self.pty = None

    def replug_elsewhere(self):
        """The adapter comes back under another name: the new terminal exists before the old one has gone."""
        old = self.pty.master
        new = rig.Pty(self.folder, self.name + ".next")
        os.unlink(self.link)
        os.close(old)
        self.lives[-1].ended_ns = time.monotonic_ns()
        self.pty = None
        return new

    def plug_prepared(self, pty):
        self.pty = pty
        os.replace(self.link + ".next", self.link)
        self.lives.append(Life())

    def is_open(self):
        if self.pty is None:
            return False
        poll = select.poll()
        poll.register(self.pty.master, select.POLLOUT)
        return not any(event & select.POLLHUP for _, event in poll.poll(0))

    def give(self, data):
        """To navcald, as far as its terminal takes it."""
        if not data:
            return
        if not self.is_open():
            self.unheard += len(data)
            return
        now_ns = time.monotonic_ns()
        try:
            taken = os.write(self.pty.master, data)
        except BlockingIOError:
            taken = 0
        self.refused += len(data) - taken
        if taken:
            self.lives[-1].add(data[:taken], now_ns)

    def from_device(self):
        while True:
            try:
                data = os.read(self.device, 4096)
            except OSError:
                return
            if not data:
                return
            self.said += data
            for piece in [data] if self.spoil is None else self.spoil(data):
                self.give(piece)

    def from_daemon(self):
        if self.pty is None:
            return
        try:
            data = os.read(self.pty.master, 4096)
        except OSError:
            return
        if not data:
            return
        self.commands += 1
        if self.spoil_command is not None:
            data = self.spoil_command(data)
        if data:
            os.write(self.device, data)
