# SPDX-License-Identifier: Apache-2.0
"""MAVLink of navcal-web where its other end fails: a TCP peer that never reads, a UDP peer that is not there or gone. Neither holds
navcal-web up, nor grows its memory, nor keeps others from their data, and a peer that comes back gets what is new.

usage: mavlink.py NAVCAL_WEB SOURCE_FOLDER
"""
import json
import socket
import sys
import threading
import time

from stand import LIMIT_S, Stand, event, free_port, get, nav, utc, wait_for

program, _ = sys.argv[1:3]
HEARTBEAT = bytes.fromhex("fd090000000101000000036e339c4c9ef8a9a8a4dc")
STATUSTEXT, ODOMETRY = 253, 331


def message_in(data):
    """Id and payload of the first frame, and what is behind it; None where it is not whole."""
    if len(data) < 12 or len(data) < 12 + data[1]:
        return None, b"", data
    assert data[0] == 0xFD, data[:12]
    end = 10 + data[1]
    return int.from_bytes(data[7:10], "little"), data[10:end], data[end + 2:]


def first_odometry(peer):
    """Age of the first estimate that comes, in seconds."""
    data, number, deadline = b"", None, time.monotonic() + LIMIT_S
    while time.monotonic() < deadline:
        number, payload, data = message_in(data)
        if number == ODOMETRY:
            return utc() - int.from_bytes(payload[:8], "little") * 1e-6
        if number is None:
            data += peer.recv(4096)
    raise AssertionError("no ODOMETRY comes")


def resident_kB(process):
    with open(f"/proc/{process.pid}/status", encoding="ascii") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmRSS"))


class Web:
    def __init__(self, stand, navcald, address):
        self.http, self.process = stand.web(program, navcald, "--mavlink", address), stand.web_process

    def metric(self, name):
        return next(float(line.split()[1]) for line in get(self.http + "/metrics")[1].splitlines()
                    if line.startswith(f"navcal_web_{name} "))

    def dropped(self):
        return self.metric("mavlink_dropped_messages_total")

    def shows_the_newest(self):
        """A browser gets what navcald says now."""
        records = json.loads(get(self.http + "/live.json")[1])["records"]
        return any(topic == "/nav" and utc() - message["time"] < 2 for topic, _, message, *_ in records)


def udp_peer(stand, port):
    peer = stand.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
    peer.settimeout(60)
    peer.sendto(HEARTBEAT, ("127.0.0.1", port))
    return peer


with Stand() as stand:
    listener = stand.enter_context(socket.socket())
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    listener.bind(("127.0.0.1", 0))
    listener.listen()
    peers = []

    def accept():
        while True:
            try:
                peers.append(listener.accept()[0])
            except OSError:
                return
    threading.Thread(target=accept, daemon=True).start()

    navcald = stand.usual_navcald()
    navcald.every(0.05, "/nav", "navigation", nav)  # enough of them also on a slow machine
    udp_port = free_port()
    tcp, udp = Web(stand, navcald, f"tcp:127.0.0.1:{listener.getsockname()[1]}"), Web(stand, navcald, f"udp:127.0.0.1:{udp_port}")
    wait_for("the TCP connection", lambda: peers)
    # Nobody has said anything to the UDP port: what goes out is lost, and counted so.
    wait_for("messages for nobody", lambda: udp.dropped() > 5)
    assert udp.metric("mavlink_sent_messages_total") == 0
    gone = udp_peer(stand, udp_port)
    assert first_odometry(gone) < 5
    gone.close()

    # Much more than any buffer holds, past peers that take nothing.
    def flood(count):
        for i in range(count):
            navcald.say("/event", None, event(f"{i:999}"))
        for web in (tcp, udp):
            wait_for("the newest for others", web.shows_the_newest)
    flood(1000)
    before = [resident_kB(web.process) for web in (tcp, udp)]
    flood(10000)
    grown = [resident_kB(web.process) - size for web, size in zip((tcp, udp), before)]
    print("12 MB of events past peers that take nothing: memory grew by", grown, "kB")
    assert max(grown) < 6000, grown
    assert tcp.dropped() > 10000, tcp.dropped()

    back = udp_peer(stand, udp_port)
    assert first_odometry(back) < 5, "a peer that comes back gets old estimates"
    # Each message is a datagram of its own, also of those that go out at once: mavlink-router cuts what is longer than 1120 bytes.
    for _ in range(5):
        navcald.say("/event", None, event("x" * 999))
    texts = 0
    while texts < 100:
        number, _, rest = message_in(back.recv(4096))
        assert not rest
        texts += number == STATUSTEXT

    # A peer that takes nothing is given up, so that no minutes of old estimates wait for it.
    wait_for("another connection", lambda: len(peers) > 1)
    peers[1].settimeout(60)
    age = first_odometry(peers[1])
    assert age < 5, age
    flood(1000)  # it does not read any more
    for web in (tcp, udp):
        stand.end(web.process)
        assert web.process.returncode == 0, "a peer that does not read holds up the end"
print("sent past peers that fail")
