# SPDX-License-Identifier: Apache-2.0
"""systemd-socket-activate listens; navcal-web must take its socket, say READY, and serve a client that was first."""
import os
import shlex
import socket
import subprocess
import sys
import tempfile
import time

program, options_file = sys.argv[1:3]
options = []
for line in open(options_file, encoding="ascii"):
    if line.startswith("OPTIONS="):
        options = shlex.split(shlex.split(line.strip())[0].removeprefix("OPTIONS="))

with socket.socket() as probe:
    probe.bind(("127.0.0.1", 0))
    port = probe.getsockname()[1]
with tempfile.TemporaryDirectory() as folder:
    manager = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
    manager.bind(os.path.join(folder, "notify"))
    manager.settimeout(60)
    web = subprocess.Popen(["systemd-socket-activate", "-l", f"127.0.0.1:{port}",
                            "-E", f"NOTIFY_SOCKET={folder}/notify", program, "--status", "127.0.0.1:1", *options])
    try:
        deadline = time.monotonic() + 60
        while True:
            try:
                client = socket.create_connection(("127.0.0.1", port), timeout=60)
                break
            except ConnectionRefusedError:
                if time.monotonic() > deadline or web.poll() is not None:
                    sys.exit("nobody listens")
                time.sleep(0.05)
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
