# SPDX-License-Identifier: Apache-2.0
"""navcal-web publishes to a real mosquitto: retained states, events, last will, login; the broker stalls, is killed and comes
back.

usage: mqtt.py NAVCAL_WEB SOURCE_FOLDER
"""
import json
import os
import signal
import subprocess
import sys
import threading
import time

from stand import Stand, compass, event, free_port, get, need, wait_for

program, _ = sys.argv[1:3]
need("mosquitto", "mosquitto_sub", "mosquitto_passwd")
LOGIN = ["-u", "auv", "-P", "word"]


class Subscriber:
    """mosquitto_sub of everything below the prefix: every message as (topic, retained, payload)."""

    def __init__(self, stand, port):
        self.messages = []
        self.process = subprocess.Popen(["mosquitto_sub", "-h", "127.0.0.1", "-p", str(port), *LOGIN, "-t", "auv/1/#", "-q", "1",
                                         "-F", "%t %r %p"], stdout=subprocess.PIPE, text=True)
        stand.callback(stand.end, self.process)
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        for line in self.process.stdout:
            topic, retained, payload = line.rstrip("\n").split(" ", 2)
            self.messages.append((topic, retained == "1", payload))

    def of(self, topic):
        return [(retained, payload) for name, retained, payload in self.messages if name == topic]


def metric(address, name):
    for line in get(address + "/metrics")[1].splitlines():
        if line.startswith(name + " "):
            return float(line.split()[1])
    return None


with Stand() as stand:
    passwords = os.path.join(stand.folder, "passwords")
    subprocess.run(["mosquitto_passwd", "-c", "-b", passwords, "auv", "word"], check=True)
    os.chmod(passwords, 0o644)  # the broker gives up its rights
    port = free_port()
    config = os.path.join(stand.folder, "mosquitto.conf")
    with open(config, "w", encoding="ascii") as file:
        file.write(f"listener {port} 127.0.0.1\nallow_anonymous false\npassword_file {passwords}\n")
    login = os.path.join(stand.folder, "login")
    with open(login, "w", encoding="ascii") as file:
        file.write("auv\nword\n")
    os.chmod(login, 0o600)

    navcald = stand.usual_navcald()
    options = ["--mqtt", f"127.0.0.1:{port}", "--mqtt-topic-prefix", "auv/1", "--mqtt-login-file", login]
    address = stand.web(program, navcald, *options)
    assert metric(address, "navcal_web_mqtt_connected") == 0, "there is no broker yet"

    broker = stand.start("mosquitto", "-c", config)
    wait_for("the broker is found", lambda: metric(address, "navcal_web_mqtt_connected") == 1)
    early = wait_for("a client of the broker", lambda: Subscriber(stand, port))
    for topic in ("auv/1/nav", "auv/1/compass/compass", "auv/1/imu/imu", "auv/1/battery/gauge", "auv/1/health", "auv/1/time"):
        wait_for(topic, lambda topic=topic: early.of(topic))
    assert json.loads(early.of("auv/1/nav")[0][1])["heading_rad"] == 1.25
    wait_for("online", lambda: [payload for _, payload in early.of("auv/1/online")][-1:] == ["1"])
    wait_for("navcald is there", lambda: [payload for _, payload in early.of("auv/1/navcald")][-1:] == ["1"])

    begin, count = time.monotonic(), len(early.of("auv/1/compass/compass"))
    wait_for("five more of the compass", lambda: len(early.of("auv/1/compass/compass")) >= count + 5)
    assert time.monotonic() - begin > 2, "not limited: the compass speaks twenty times a second"
    navcald.say("/event", None, event("dive 3"))
    navcald.say("/event", None, event("dive 4"))
    wait_for("both events", lambda: len(early.of("auv/1/event")) == 2)

    late = Subscriber(stand, port)
    wait_for("the retained state", lambda: late.of("auv/1/nav") and late.of("auv/1/online"))
    assert late.of("auv/1/nav")[0][0] and late.of("auv/1/online")[0] == (True, "1"), "retained"
    assert not late.of("auv/1/event"), "events are not retained"

    navcald.sources = [one for one in navcald.sources if one[2] != "/compass"]
    navcald.say("/compass", "compass", compass(heading_rad=0.5))
    navcald.say("/compass", "compass", compass(heading_rad=0.75))
    wait_for("the newest of a device that fell silent",
             lambda: json.loads(early.of("auv/1/compass/compass")[-1][1])["heading_rad"] == 0.75)

    broker.kill()
    broker.wait()
    wait_for("the broker is missed", lambda: metric(address, "navcal_web_mqtt_connected") == 0)
    navcald.say("/event", None, event("while it was away"))
    lines = metric(address, "navcal_web_status_lines_total")
    wait_for("the server goes on", lambda: metric(address, "navcal_web_status_lines_total") > lines + 20)
    broker = stand.start("mosquitto", "-c", config)
    wait_for("the broker is found again", lambda: metric(address, "navcal_web_mqtt_connected") == 1)
    again = Subscriber(stand, port)
    wait_for("the state, although the broker forgot it", lambda: again.of("auv/1/nav") and again.of("auv/1/compass/compass"))
    wait_for("online again", lambda: (True, "1") in again.of("auv/1/online"))

    broker.send_signal(signal.SIGSTOP)
    lines = metric(address, "navcal_web_status_lines_total")
    wait_for("a broker that stalls holds up nothing", lambda: metric(address, "navcal_web_status_lines_total") > lines + 40)
    wait_for("a broker that is silent is given up", lambda: metric(address, "navcal_web_mqtt_connected") == 0)
    broker.send_signal(signal.SIGCONT)
    wait_for("and found again", lambda: metric(address, "navcal_web_mqtt_connected") == 1)

    navcald.close()
    wait_for("navcald is gone", lambda: [payload for _, payload in again.of("auv/1/navcald")][-1:] == ["0"])
    stand.web_process.kill()
    wait_for("the last will", lambda: [payload for _, payload in again.of("auv/1/online")][-1:] == ["0"])

    navcald = stand.usual_navcald()
    address = stand.web(program, navcald, *options)
    wait_for("online", lambda: [payload for _, payload in again.of("auv/1/online")][-1:] == ["1"])
    with open(f"/proc/{stand.web_process.pid}/status", encoding="ascii") as file:
        print("with MQTT:", *[line.strip() for line in file if line.startswith(("VmRSS", "RssAnon"))])
    stand.end(stand.web_process)
    assert stand.web_process.returncode == 0, stand.web_process.returncode
    wait_for("a good-bye", lambda: [payload for _, payload in again.of("auv/1/online")][-1:] == ["0"])

    with open(login, "w", encoding="ascii") as file:
        file.write("auv\nwrong\n")
    address = stand.web(program, navcald, *options)
    wait_for("a refusal is told", lambda: "not authorised" in open(f"{stand.folder}/navcal-web.log", errors="replace").read())
    assert metric(address, "navcal_web_mqtt_connected") == 0
    stand.end(stand.web_process)
    address = stand.web(program, navcald)
    with open(f"/proc/{stand.web_process.pid}/status", encoding="ascii") as file:
        print("without MQTT:", *[line.strip() for line in file if line.startswith(("VmRSS", "RssAnon"))])
    with open(f"/proc/{stand.web_process.pid}/maps", encoding="ascii") as file:
        assert "libssl" not in file.read(), "OpenSSL is loaded without need"
print("published")
