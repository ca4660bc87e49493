# SPDX-License-Identifier: Apache-2.0
"""A real navcald with a receiver on a pseudo-terminal: what it says reaches /metrics and Signal K.

usage: real_daemon.py NAVCAL_WEB SOURCE_FOLDER NAVCALD
"""
import contextlib
import datetime
import os
import sys
import threading
import time
import tty

from stand import Stand, free_port, get, wait_for

program, _, daemon = sys.argv[1:4]


def sentence(text):
    checksum = 0
    for byte in text.encode():
        checksum ^= byte
    return f"${text}*{checksum:02X}\r\n".encode()


class Receiver:
    """Speaks once a second until it is closed."""

    def __init__(self):
        self.master, self.slave = os.openpty()
        tty.setraw(self.slave)
        os.set_blocking(self.master, False)
        self.path = os.ttyname(self.slave)
        self.open = True
        threading.Thread(target=self._speak, daemon=True).start()

    def _speak(self):
        while self.open:
            now = datetime.datetime.now(datetime.timezone.utc)
            clock = now.strftime("%H%M%S.00")
            with contextlib.suppress(OSError):
                os.write(self.master, sentence(f"GPRMC,{clock},A,5919.956,N,01803.894,E,1.0,90.0,{now:%d%m%y},,,A")
                         + sentence(f"GPGGA,{clock},5919.956,N,01803.894,E,1,08,0.9,12.0,M,24.0,M,,"))
            time.sleep(1)

    def close(self):
        self.open = False


with Stand() as stand:
    receiver = Receiver()
    stand.callback(receiver.close)
    config = os.path.join(stand.folder, "navcald.toml")
    port = free_port()
    with open(config, "w", encoding="ascii") as file:
        file.write(f'[log]\nenabled = false\n[status]\nport = {port}\n[control]\nsocket = "{stand.folder}/control"\n'
                   f'[port.gps]\nprotocol = "nmea"\npath = "{receiver.path}"\n'
                   f'[port."compass"]\nprotocol = "tcm2"\npath = "{stand.folder}/nothing"\n')
    stand.start(daemon, "--config", config)

    class Address:
        pass
    Address.port = port
    address = stand.web(program, Address)

    def page():
        return get(address + "/metrics")[1].splitlines()

    def value(name):
        found = [line for line in page() if line.startswith(name + " ")]
        return float(found[0].rsplit(" ", 1)[1]) if found else None

    wait_for("navcald", lambda: value("navcald_up") == 1)
    wait_for("frames of the receiver", lambda: (value('navcald_port_frames_total{device="gps"}') or 0) >= 4)
    wait_for("its state", lambda: value('navcald_port_state{device="gps",state="running"}') == 1)
    assert value('navcald_port_state{device="compass",state="away"}') == 1, page()
    assert value('navcald_log_state{state="off"}') == 1
    assert value('navcald_port_bad_checksums_total{device="gps"}') == 0
    wait_for("its latencies", lambda: (value('navcald_port_latency_seconds_count{device="gps"}') or 0) >= 2)
    assert value("navcald_uptime_seconds") > 0 and value("navcald_status_clients") >= 1
    assert value("navcal_web_status_not_understood_lines_total") == 0, "a line of navcald that nobody knows"
    for absent in ("navcald_depth_meters", "navcald_heading_radians", "navcald_altitude_meters"):
        assert value(absent) is None, f"{absent} = {value(absent)}, without an instrument"
print("told")
