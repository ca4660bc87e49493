# SPDX-License-Identifier: Apache-2.0
"""Reports of a running navcald, one dictionary after the other, while they come.

    import navcal.live

    for state in navcal.live.reports(classes=["STATE"], rate_Hz={"STATE": 2}):
        print(state["depth_m"], state["heading_rad"])

The classes and their keys stand in the document of the status protocol.
"""
from __future__ import annotations

import json
import socket
import time
from typing import Any, Iterator, Mapping, Sequence

__all__ = ["NavcalError", "reports"]


class NavcalError(RuntimeError):
    """navcald refused the request, and says why."""


def _lines(connection: socket.socket) -> Iterator[bytes]:
    rest = b""
    while chunk := connection.recv(65536):
        *whole, rest = (rest + chunk).split(b"\n")
        yield from whole


def reports(
    host: str = "127.0.0.1",
    port: int = 2947,
    *,
    classes: Sequence[str] | None = None,
    topics: Sequence[str] | None = None,
    device: str | None = None,
    rate_Hz: Mapping[str, float] | None = None,
    reconnect_s: float | None = None,
    timeout_s: float = 5,
) -> Iterator[dict[str, Any]]:
    """Yields the reports of navcald's status socket as dictionaries, in the order in which they come.

    classes, topics, device, rate_Hz: as in ?WATCH; None leaves navcald's usual choice. The answers to the request
    (VERSION, DEVICES, WATCH) are not yielded.
    reconnect_s: after the connection is lost, tries again after so many seconds; None: the iterator ends there.
    timeout_s: to connect; reports may be silent for longer.

    Raises NavcalError when navcald refuses the request, OSError when there is no connection, and json.JSONDecodeError
    when the other side does not speak JSON. Leaving the loop closes the connection.
    """
    wanted: dict[str, Any] = {"enable": True, "json": True}
    given = {"classes": classes, "topics": topics, "device": device, "rate_Hz": rate_Hz}
    wanted.update({key: value for key, value in given.items() if value is not None})
    request = b"?WATCH=" + json.dumps(wanted).encode() + b";\n"
    was_connected = False
    while True:
        try:
            with socket.create_connection((host, port), timeout_s) as connection:
                connection.settimeout(None)
                connection.sendall(request)
                was_connected = True
                for line in _lines(connection):
                    report = json.loads(line)
                    if report.get("class") == "ERROR":
                        raise NavcalError(report.get("message", "refused without a reason"))
                    if report.get("class") not in ("VERSION", "DEVICES", "WATCH"):
                        yield report
        except OSError:
            if reconnect_s is None or not was_connected:
                raise
        if reconnect_s is None:
            return
        time.sleep(reconnect_s)
