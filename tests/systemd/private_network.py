# SPDX-License-Identifier: Apache-2.0
"""systemd-socket-activate listens; the daemon runs in a network namespace of its own and must serve a client."""
import os
import socket
import subprocess
import sys

import activated

navcald, work = sys.argv[1:3]
port = activated.free_port()
control = os.path.join(work, "control")
master, slave = os.openpty()
config = os.path.join(work, "navcald.toml")
with open(config, "w", encoding="ascii") as file:
    file.write(f'[log]\nenabled = false\n[port.gps]\nprotocol = "nmea"\npath = "{os.ttyname(slave)}"\n')

daemon = subprocess.Popen(
    ["systemd-socket-activate", "-l", f"127.0.0.1:{port}", "-l", control, "unshare", "--net", navcald, "--config", config])
try:
    client = activated.first_client(port, daemon)
    greeting = client.makefile().readline()
    print(greeting.strip())
    if '"class":"VERSION"' not in greeting:
        sys.exit("no greeting from the daemon")
    if socket.create_connection(("127.0.0.1", port), timeout=60).makefile().readline() != greeting:
        sys.exit("a second client is not greeted alike")
finally:
    daemon.terminate()
    daemon.wait(60)
