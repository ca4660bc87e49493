# SPDX-License-Identifier: Apache-2.0
"""What the tests of socket activation share: a free port, and the first client of a service that is being started."""
import socket
import sys
import time


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def first_client(port, process):
    """A connection to the port, as soon as somebody listens there; ends the test when nobody does."""
    deadline = time.monotonic() + 60
    while True:
        try:
            return socket.create_connection(("127.0.0.1", port), timeout=60)
        except ConnectionRefusedError:
            if time.monotonic() > deadline or process.poll() is not None:
                sys.exit("nobody listens")
            time.sleep(0.05)
