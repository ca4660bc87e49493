# SPDX-License-Identifier: Apache-2.0
"""navcal.live against a real navcald that reads emulated instruments."""
import os
import pathlib
import socket
import subprocess
import tempfile
import threading
import time
import unittest

import navcal.live


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def wait_for(condition, what):
    until = time.monotonic() + 30
    while not condition():
        if time.monotonic() > until:
            raise TimeoutError(what)
        time.sleep(0.05)


class Live(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        folder = pathlib.Path(self.folder.name)
        self.port = free_port()
        lines = [f"status.port = {self.port}", f'control.socket = "{folder}/control"', "log.enabled = false"]
        for name, protocol in (("compass", "tcm2"), ("imu", "imu-card"), ("gps", "oncore"), ("motor", "motor-card")):
            lines += [f'port.{name}.protocol = "{protocol}"', f'port.{name}.path = "{folder}/ports/{name}"']
        lines.append("port.compass.baud = 38400")
        (folder / "navcald.toml").write_text("\n".join(lines) + "\n")
        self.start(os.environ["NAVCAL"], "emulate", "--mission", "survey", "--dir", str(folder / "ports"))
        wait_for((folder / "ports" / "motor").exists, "the emulated ports")
        self.start(os.environ["NAVCALD"], "--config", str(folder / "navcald.toml"))
        wait_for((folder / "control").exists, "navcald")

    def start(self, *command):
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(process.wait)
        self.addCleanup(process.terminate)

    def test_yields_what_was_asked_for(self):
        seen = []
        for report in navcal.live.reports(port=self.port, classes=["RECORD"], topics=["/imu", "/compass"]):
            self.assertEqual(report["class"], "RECORD")
            seen.append(report["topic"])
            if len(seen) > 20 and len(set(seen)) == 2:
                break
        self.assertEqual(set(seen), {"/imu", "/compass"})

    def test_a_refusal_names_the_reason(self):
        with self.assertRaisesRegex(navcal.live.NavcalError, "class that is not known"):
            next(navcal.live.reports(port=self.port, classes=["WIND"]))


class NoDaemon(unittest.TestCase):
    def test_no_connection_is_an_error_at_once(self):
        with self.assertRaises(OSError):
            next(navcal.live.reports(port=free_port(), reconnect_s=0.1))

    def test_a_peer_that_goes_ends_the_iterator_and_garbage_is_told(self):
        with socket.create_server(("127.0.0.1", 0)) as server:
            for answer, expected in ((b'{"class":"TPV"}\n{"class":', None), (b"no JSON\n", ValueError)):
                iterator = navcal.live.reports(port=server.getsockname()[1])
                def speak():
                    connection, _ = server.accept()
                    with connection:
                        connection.recv(1000)
                        connection.sendall(answer)

                speaker = threading.Thread(target=speak)
                speaker.start()
                if expected is None:
                    self.assertEqual([report["class"] for report in iterator], ["TPV"])
                else:
                    with self.assertRaises(expected):
                        list(iterator)
                speaker.join()


if __name__ == "__main__":
    unittest.main()
