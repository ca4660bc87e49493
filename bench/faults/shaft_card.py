# SPDX-License-Identifier: Apache-2.0
"""A motor card on a pseudo-terminal: obeys the last intact order for ever, and has no time-out of its own."""
import os
import select
import termios
import time

import serial_rig as rig

STATUS_S = 0.1


class Card:
    """`on_line(time, rpm, heard)` is called for each intact order at the card's end of the wire, before the card obeys."""

    def __init__(self, folder, on_line):
        self.folder, self.on_line = folder, on_line
        self.rpm, self.sequence, self.status_due = 0, 0, time.monotonic()
        self.lines_to_lose, self.is_deaf, self.is_silent = 0, False, False
        self.plug()

    def plug(self):
        self.pty, self.rest = rig.Pty(self.folder, "motor"), b""

    def unplug(self):
        os.unlink(self.pty.link)
        os.close(self.pty.master)
        self.pty = None

    def run(self, wait_s):
        """Waits at most so long for bytes, reads orders, and sends the status when it is due."""
        if self.pty is None:
            return time.sleep(wait_s)
        readable, _, _ = select.select([self.pty.master], [], [], wait_s)
        is_open = True
        if readable:
            try:
                self.read(os.read(self.pty.master, 4096))
            except OSError:
                is_open = False
                time.sleep(wait_s)  # select() does not wait while nobody has the port open
        if time.monotonic() >= self.status_due:
            self.status_due = max(self.status_due + STATUS_S, time.monotonic())
            self.send_status(is_open)

    def read(self, data):
        now = time.monotonic()
        *lines, self.rest = (self.rest + data).split(b"\n")
        for line in lines:
            fields = line[1:].split(b"*")[0].decode("latin1").split(",")
            if line + b"\n" != rig.sentence(",".join(fields)) or fields[0] != "MCC" or len(fields) != 5:
                continue
            heard = not self.is_deaf and self.lines_to_lose == 0
            self.lines_to_lose = max(0, self.lines_to_lose - 1)
            self.on_line(now, int(fields[1]), heard)
            if heard:
                self.rpm = int(fields[1])

    def send_status(self, is_open):
        self.sequence = (self.sequence + 1) % 256
        if not is_open:
            # A serial line keeps nothing for who opens it later; a pseudo-terminal would.
            termios.tcflush(self.pty.master, termios.TCIOFLUSH)
        elif not self.is_silent:
            self.pty.write(rig.sentence(f"MCS,{self.sequence},{self.rpm},{self.rpm},0.0,0.0,0.0,0.50"))
