# SPDX-License-Identifier: Apache-2.0
"""What hostile and careless clients do to a TCP port, in a process of its own that yields to everybody."""
import multiprocessing
import os
import random
import socket
import time

WATCH = b'?WATCH={"enable":true,"json":true};\n'
ENOUGH_S = 0.05  # a crowd, not a contest for the processor
PIECES = (b"?WATCH=", b'{"enable":true', b'"json":1e999', b"};", b"?POLL;", b"?DEVICE={", b'"path":"', b"\\u0000", b"\xff\xfe",
          b"[" * 200, b"?VERSION", b";;;;", b"\r\n", b'"raw":-1', b"\0", b"%s%n", b"\n")


def connected(port, buffer_bytes=None):
    s = socket.socket()
    if buffer_bytes:
        s.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, buffer_bytes)
    s.settimeout(5)
    s.connect(("127.0.0.1", port))
    return s


def never_read(port):
    s = connected(port, 4096)
    s.sendall(WATCH)
    return s


def half_request(port):
    """Says a part of a request, and nothing more."""
    s = connected(port)
    s.sendall(WATCH[:11])
    return s


def send_all_you_can(s, data):
    try:
        s.settimeout(1)
        s.sendall(data)
    except OSError:
        pass  # closed by the daemon, as it should


def megabyte_without_newline(port, rng):
    with connected(port) as s:
        send_all_you_can(s, rng.choice((b"A", b"?", b"{", b"\0")) * 1_000_000)


def malformed(port, rng):
    with connected(port) as s:
        for _ in range(20):
            send_all_you_can(s, b"".join(rng.choices(PIECES, k=rng.randrange(1, 12))) + rng.randbytes(rng.randrange(40)))


def slam(port, rng):
    """Connects and resets, with or without a request on the way."""
    with connected(port) as s:
        if rng.random() < 0.5:
            s.sendall(WATCH)
        s.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\1\0\0\0\0\0\0\0")


ACTIVE = (megabyte_without_newline, malformed, slam)


def attack(port, clients, seed, stop, counts):
    os.nice(10)
    rng = random.Random(seed)
    held = []
    for i in range(clients):
        held.append(never_read(port) if i % 2 else half_request(port))
    counts[0] = len(held)
    while not stop.is_set():
        try:
            rng.choice(ACTIVE)(port, rng)
        except OSError:
            counts[2] += 1
        counts[1] += 1
        time.sleep(ENOUGH_S)
    for s in held:
        s.close()


class Attack:
    """`with Attack(port, clients, seed)`: under way inside."""

    def __init__(self, port, clients, seed):
        self.stop = multiprocessing.Event()
        self.counts = multiprocessing.Array("i", 3)  # clients held, acts, acts that could not be
        self.process = multiprocessing.Process(target=attack, args=(port, clients, seed, self.stop, self.counts))
        self.clients = clients

    def __enter__(self):
        self.process.start()
        end = time.monotonic() + 30
        while self.counts[0] < self.clients and time.monotonic() < end:
            time.sleep(0.02)
        return self

    def __exit__(self, *_):
        self.stop.set()
        self.process.join(10)
        if self.process.is_alive():
            self.process.kill()
            self.process.join()
