# SPDX-License-Identifier: Apache-2.0
"""systemd-socket-activate listens; navcal-web must take its socket, say READY, and serve a client that was first."""
import os
import shlex
import socket
import subprocess
import sys
import tempfile

import activated

program, options_file = sys.argv[1:3]
options = []
for line in open(options_file, encoding="ascii"):
    if line.startswith("OPTIONS="):
        options = shlex.split(shlex.split(line.strip())[0].removeprefix("OPTIONS="))

port = activated.free_port()
with tempfile.TemporaryDirectory() as folder:
    manager = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
    manager.bind(os.path.join(folder, "notify"))
    manager.settimeout(60)
    web = subprocess.Popen(["systemd-socket-activate", "-l", f"127.0.0.1:{port}",
                            "-E", f"NOTIFY_SOCKET={folder}/notify", program, "--status", "127.0.0.1:1", *options])
    try:
        client = activated.first_client(port, web)
        client.sendall(b"GET /nothing HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
        answer = client.makefile().read()
        if not answer.startswith("HTTP/1.1 404"):
            sys.exit(f"not served: {answer[:200]}")
        said = manager.recv(4096).decode()
        if "READY=1" not in said:
            sys.exit(f"not READY=1 but {said}")
        print(f"served; the manager heard {said}")
    finally:
        web.terminate()
        web.wait(60)
