# SPDX-License-Identifier: Apache-2.0
"""systemd-socket-activate listens; the daemon runs in a network namespace of its own and must serve a client."""
import os
import socket
import subprocess
import sys
import time

navcald, work = sys.argv[1:3]
with socket.socket() as probe:
    probe.bind(("127.0.0.1", 0))
    port = probe.getsockname()[1]
control = os.path.join(work, "control")
master, slave = os.openpty()
config = os.path.join(work, "navcald.toml")
with open(config, "w", encoding="ascii") as file:
    file.write(f'[log]\nenabled = false\n[port.gps]\nprotocol = "nmea"\npath = "{os.ttyname(slave)}"\n')

daemon = subprocess.Popen(
    ["systemd-socket-activate", "-l", f"127.0.0.1:{port}", "-l", control, "unshare", "--net", navcald, "--config", config])
try:
    deadline = time.monotonic() + 60
    while True:
        try:
            client = socket.create_connection(("127.0.0.1", port), timeout=60)
            break
        except ConnectionRefusedError:
            if time.monotonic() > deadline or daemon.poll() is not None:
                sys.exit("nobody listens")
            time.sleep(0.05)
    greeting = client.makefile().readline()
    print(greeting.strip())
    if '"class":"VERSION"' not in greeting:
        sys.exit("no greeting from the daemon")
    if socket.create_connection(("127.0.0.1", port), timeout=60).makefile().readline() != greeting:
        sys.exit("a second client is not greeted alike")
finally:
    daemon.terminate()
    daemon.wait(60)
