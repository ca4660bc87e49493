# SPDX-License-Identifier: Apache-2.0
"""Missions, vehicles and places, and the samples of a simulated recording with its true motion."""
import csv
import json
import math
import random
import re
import subprocess

from writers import LATENCY_S, Sample, kind_of

# Latitude and longitude. The simulator's own reference field belongs to no place: no model has its declination.
PLACES = [(37.06, -80.63), (59.33, 18.07), (21.3, -157.9), (-34.1, 18.4), (-41.3, 174.8), (38.7, -9.2), (44.6, -63.5)]
MISSION = """mission.description = "Circles both ways, changes of speed, dives between fixes"
mission.at_end = "repeat"
start.depth_m = 0.15
start.shaft_rpm = 700
step = [
  {do = "surface", seconds = 30},
  {do = "circle", turns = 2, rate_deg_s = 15},
  {do = "circle", turns = -2, rate_deg_s = 20},
  {do = "dive", depth_m = 2.5},
  {do = "leg", heading_deg = 40, seconds = 25},
  {do = "speed", shaft_rpm = 900, seconds = 15},
  {do = "speed", shaft_rpm = 500, seconds = 15},
  {do = "speed", shaft_rpm = 800, seconds = 15},
  {do = "turn", by_deg = 130},
  {do = "leg", seconds = 25},
  {do = "spiral", turns = 2, depth_m = 5, rate_deg_s = 20},
  {do = "surface", seconds = 40},
]
"""
MISSIONS = ["identification", "calibration_swing", "survey", "own"]
VEHICLES = ["reference", "reference", "reference", "bluerov2-heavy.toml", "micro-auv.toml"]
SECONDS = 420
CONFIG = "".join(f'[port.{port}]\nprotocol = "{protocol}"\npath = "/dev/{port}"\n'
                 for port, protocol in (("compass", "tcm2"), ("imu", "imu-card"), ("gps", "oncore"), ("motor", "motor-card")))
CONFIG += "[instruments]\nimu_turn_on_bias_deg_s = 0.0001\n"


class Truth:
    """The true motion, 10 rows a second, and the Earth's field there."""

    def __init__(self, file, field_ned, begin_s):
        with open(file) as opened:
            rows = list(csv.DictReader(opened))[::10]
        names = ("t", "z", "phi", "theta", "psi", "u", "v", "w")
        self.t, self.z, self.phi, self.theta, self.psi, *self.velocity = ([float(row[name]) for row in rows] for name in names)
        self.field_ned, self.begin_s = field_ned, begin_s
        self.declination_rad = math.atan2(field_ned[1], field_ned[0])

    def index(self, time_s):
        return max(0, min(len(self.t) - 1, round(10 * (time_s - self.begin_s))))

    def in_body(self, i):
        cf, sf = math.cos(self.phi[i]), math.sin(self.phi[i])
        ct, st = math.cos(self.theta[i]), math.sin(self.theta[i])
        cp, sp = math.cos(self.psi[i]), math.sin(self.psi[i])
        north, east, down = self.field_ned
        return (ct * cp * north + ct * sp * east - st * down,
                (sf * st * cp - cf * sp) * north + (sf * st * sp + cf * cp) * east + sf * ct * down,
                (cf * st * cp + sf * sp) * north + (cf * st * sp - sf * cp) * east + cf * ct * down)

    def heading_of(self, field, i):
        """Of a field in body axes, levelled by the true tilt: clockwise from magnetic north."""
        x, y, z = field
        roll, pitch = self.phi[i], self.theta[i]
        level_y = y * math.cos(roll) - z * math.sin(roll)
        across = y * math.sin(roll) + z * math.cos(roll)
        return math.atan2(-level_y, x * math.cos(pitch) + across * math.sin(pitch))

    def worst_heading_deg(self, disturbed, from_s=0.0):
        """Largest mean error of the heading in a sector of ten degrees; `disturbed` makes the measured field."""
        sums = {}
        for i, time_s in enumerate(self.t):
            if time_s < from_s:
                continue
            field = self.in_body(i)
            right = self.heading_of(field, i)
            error = math.remainder(self.heading_of(disturbed(field), i) - right, 2 * math.pi)
            sums.setdefault(int(right % (2 * math.pi) / math.radians(10)), []).append(error)
        return math.degrees(max(abs(sum(errors)) / len(errors) for errors in sums.values() if len(errors) > 2))


def simulated(navcal, repository, folder, case, effects):
    """Makes folder/sim.cap; its truth."""
    command = [navcal, "simulate", "--seed", str(case["simulator_seed"]), "--seconds",
               str(case.get("seconds", SECONDS)), "-o", str(folder / "sim.cap"), "--truth", str(folder / "truth.csv")]
    mission = case["mission"]
    if mission not in MISSIONS[:-1]:
        (folder / "mission.toml").write_text(MISSION if mission == "own" else mission)
        mission = str(folder / "mission.toml")
    command += ["--mission", mission]
    if case["vehicle"] != "reference":
        command += ["--vehicle", str(repository / "share" / "vehicles" / case["vehicle"])]
    command += ["--place", "{},{}".format(*case["place"])]
    # Gyros without a bias: it is planted where there is to be one.
    (folder / "config.toml").write_text(CONFIG)
    command += ["--config", str(folder / "config.toml")]
    if effects:
        (folder / "effects.toml").write_text(effects)
        command += ["--effects", str(folder / "effects.toml")]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{command}: {done.stderr}")
    text = (folder / "sim.cap").read_text()
    field = re.search(r"simulated field of the Earth: north (\S+), east (\S+), down (\S+) uT", text)
    begin_s = float(re.search(r"^(\d+)\.\d+ ", text, re.M).group(1))
    return Truth(folder / "truth.csv", [float(axis) for axis in field.groups()], begin_s)


KEYS = {"compass": ("heading_rad", "pitch_rad", "roll_rad", "field_body_uT"),
        "imu": ("rate_rad_s", "specific_force_m_s2", "yaw_rate_b_rad_s", "depth_m"),
        "gps": ("lat", "lon", "fix", "height_m", "speed_m_s", "course_rad", "tracked"),
        "motor": ("rpm", "rpm_commanded", "fins_rad", "current_A")}


def samples_of(navcal, capture):
    """The samples of a capture by port, as navcal replays them."""
    done = subprocess.run([navcal, "replay", "--json", str(capture)], check=True, capture_output=True, text=True)
    log = {}
    for line in done.stdout.splitlines():
        row = json.loads(line)
        port = row.get("device")
        if port not in KEYS or row.get("time") is None:
            continue
        values = {key: row[key] for key in KEYS[port] if row.get(key) is not None}
        if values:
            log.setdefault(port, []).append(Sample(row["time"], row["time"] + LATENCY_S[kind_of(port)], values))
    return log


def as_autopilot(log, truth, dice):
    """What an autopilot logs: its own estimate of the attitude, a depth of its own, and no tilt of the compass."""
    error = [0.0, 0.0, 0.0]
    attitude = []
    for i in range(len(truth.t)):
        # 0.3 degrees, for half a minute
        error = [0.9967 * e + dice.gauss(0, math.radians(0.3) * 0.0815) for e in error]
        time_s = truth.begin_s + truth.t[i]
        values = {"roll_rad": truth.phi[i] + error[0], "pitch_rad": truth.theta[i] + error[1],
                  "heading_rad": (truth.psi[i] + error[2]) % (2 * math.pi), "heading_is_true": True}
        attitude.append(Sample(time_s, time_s + LATENCY_S["attitude"], values))
    depth = [Sample(s.time_s, s.arrival_s + 0.001, {"depth_m": s.values["depth_m"]}) for s in log["imu"] if "depth_m" in s.values]
    log["attitude"], log["depth"] = attitude, depth
    for sample in log["compass"]:
        sample.values = {"field_body_uT": sample.values["field_body_uT"]}
    for sample in log["imu"]:
        sample.values = {key: sample.values[key] for key in ("rate_rad_s", "specific_force_m_s2")}
    if "motor" in log:
        for sample in log["motor"]:
            sample.values = {"current_A": sample.values["current_A"]}

def second_compass(log, dice):
    log["compass2"] = [Sample(s.time_s, s.arrival_s + 0.002, {"field_body_uT": [axis + dice.gauss(0, 0.15) for axis in s.values["field_body_uT"]]})
                       for s in log["compass"]]


def doppler_log(log, truth, dice):
    """Five pings a second over a floor at 30 m, with 5 mm/s of noise. The current over the bottom is none."""
    log["dvl"] = []
    for i in range(0, len(truth.t), 2):
        values = {"frame": "body", "bottom_velocity_m_s": [axis[i] + dice.gauss(0, 0.005) for axis in truth.velocity],
                  "altitude_m": 30 - truth.z[i]}
        time_s = truth.begin_s + truth.t[i]
        log["dvl"].append(Sample(time_s, time_s + LATENCY_S["dvl"], values))


def random_of(*parts):
    return random.Random(" ".join(str(part) for part in parts))
