# SPDX-License-Identifier: Apache-2.0
"""A real signalk-server reads navcal-web as a Signal K source, and shows heading, attitude, depth, position and their errors.

usage: signalk.py NAVCAL_WEB SOURCE_FOLDER
"""
import datetime
import json
import os
import sys
import time

from stand import SKIPPED, Stand, compass, free_port, get_json, nav, need, utc, wait_for

program, source = sys.argv[1:3]
need("node")
modules = os.environ.get("NAVCAL_SIGNALK_MODULES", f"{source}/tests/web/signalk/node_modules")
server = os.path.join(modules, "signalk-server/bin/signalk-server")
if not os.path.exists(server):
    print("skipped: there is no signalk-server here; npm install in tests/web/signalk (270 MB) gets it")
    sys.exit(SKIPPED)


def seconds_of(timestamp):
    return datetime.datetime.fromisoformat(timestamp.replace("Z", "+00:00")).timestamp()


with Stand() as stand:
    navcald = stand.usual_navcald()
    heading = [1.25]
    navcald.sources[1][4] = lambda: nav(heading_rad=heading[0])
    address = stand.web(program, navcald)
    discovery = get_json(address + "/signalk")
    own = get_json(address + "/signalk/v1/api/self")
    assert discovery["endpoints"]["v1"]["signalk-ws"] == address.replace("http", "ws") + "/signalk/v1/stream", discovery
    assert own.startswith("vessels.urn:mrn:signalk:uuid:"), own

    port = free_port()
    settings = {"interfaces": {}, "ssl": False, "mdns": False, "port": port, "pipedProviders": [{
        "id": "auv", "enabled": True, "pipeElements": [{"type": "providers/simple", "options": {
            "logging": False, "type": "SignalK", "subOptions": {
                "type": "ws", "host": "127.0.0.1", "port": int(address.rsplit(":", 1)[1]), "useDiscovery": False,
                "selfHandling": "useRemoteSelf"}}}]}]}
    with open(os.path.join(stand.folder, "settings.json"), "w", encoding="ascii") as file:
        json.dump(settings, file)
    stand.start("node", server, "-c", stand.folder,
                env={**os.environ, "PORT": str(port), "SIGNALK_NODE_CONFIG_DIR": stand.folder, "HOME": stand.folder})
    api = f"http://127.0.0.1:{port}/signalk/v1/api/vessels/self/"

    def value(path):
        return get_json(api + path.replace(".", "/") + "/value")

    expected = {
        "navigation.headingTrue": 1.25, "navigation.headingTrue.standardError": 0.0875, "navigation.headingMagnetic": 1.175,
        "navigation.headingMagnetic.standardError": 0.0088, "navigation.headingCompass": 1.2,
        "navigation.attitude": {"roll": 0.01, "pitch": -0.2, "yaw": 1.25}, "navigation.rateOfTurn": 0.025,
        "navigation.position": {"latitude": 59.3326, "longitude": 18.0649},
        "navigation.position.standardError": {"north": 1.5, "east": 2.5}, "navigation.speedThroughWater": 1.125,
        "navigation.speedOverGround": 1.0, "environment.depth.surfaceToTransducer": 6.25,
        "electrical.batteries.gauge.voltage": 22.5, "electrical.batteries.gauge.capacity.stateOfCharge": 0.5,
        "electrical.batteries.gauge.capacity.remainingCharge.standardError": 180.0}
    wait_for("the server has a heading", lambda: value("navigation.headingTrue"))
    for path, wanted in expected.items():
        got = wait_for(path, lambda path=path: [value(path)])[0]
        assert got == wanted, f"{path}: {got}, not {wanted}"
    course = value("navigation.courseOverGroundTrue")
    assert abs(course - 1.5707963) < 1e-6, course

    shown = get_json(api + "navigation/headingTrue")
    assert shown["meta"]["units"] == "rad", shown
    assert get_json(api + "navigation/headingTrue/standardError")["meta"]["units"] == "rad"
    age_s = utc() - seconds_of(shown["timestamp"])
    assert -1 < age_s < 60, f"not the time of validity: {shown}"
    try:
        value("environment.depth.belowSurface")
        raise AssertionError("a depth of the water that nobody measured")
    except OSError:
        pass

    delays_s = []
    for step in range(20):
        heading[0] = round(1.3 + step / 100, 6)
        begin = time.monotonic()
        wait_for("the new heading", lambda: value("navigation.headingTrue") == heading[0])
        delays_s.append(time.monotonic() - begin)
    print(f"a new heading is shown after {sorted(delays_s)[10]:.3f} s (median), {max(delays_s):.3f} s (largest of 20)")

    navcald.close()
    wait_for("what is not known is null", lambda: get_json(api + "navigation/headingTrue")["value"] is None)
print("signalk-server shows it all")
