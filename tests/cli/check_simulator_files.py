#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads the files of `navcal gap --export` with readers of its own and turns their numbers back into found effects.

usage: check_simulator_files.py NAVCAL
Every effect of the library is written as a found one. It must come back from each simulator's file to 1e-6, or be named there
among the effects left out, with a reason. Names of parameters, keys, elements and attributes are compared with those that the
simulators' own sources and documents have.
"""

import cmath
import itertools
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

FIELD_UT = [15.0, 1.5, 49.0]
# ArduPilot's libraries/SITL: SITL.cpp, SIM_GPS.cpp, and AP_InertialSensor_tempcal.cpp.
SITL_SCALARS = {"SIM_BUOYANCY", "SIM_GPS1_LAG_MS", "SIM_IMUT_END", "SIM_IMUT_FIXED", "SIM_IMUT_START", "SIM_IMUT_TCONST",
                "SIM_MAG_ALY_HGT", "SIM_MAG_DELAY", "SIM_WIND_DIR", "SIM_WIND_DIR_Z", "SIM_WIND_SPD", "SIM_WIND_T",
                "SIM_WIND_TURB"} | {f"SIM_IMUT{n}_{key}" for n in (1, 2) for key in ("ENABLE", "TMIN", "TMAX")}
SITL_VECTORS = {"SIM_GPS1_POS", "SIM_MAG_ALY", "SIM_MAG_MOT"} | {
    f"SIM_MAG{n}_{key}" for n in (1, 2, 3) for key in ("OFS", "DIA", "ODI")} | {
    name.format(n) for n in (1, 2) for name in ("SIM_ACC{}_BIAS", "SIM_ACC{}_SCAL", "SIM_GYR{}_SCALE", "SIM_IMUT{}_GYR1")}
SITL_WHOLE = {"SIM_GPS1_LAG_MS", "SIM_MAG_DELAY"}
# HoloOcean: "Scenarios", "Agent Configuration", "Sensor Configuration", "Fossen-Based Dynamics", API of the sensors.
HOLOOCEAN = {
    "scenario": {"name", "world", "package_name", "main_agent", "ticks_per_sec", "agents"},
    "agent": {"agent_name", "agent_type", "sensors", "control_scheme", "location", "rotation", "fossen_model", "control_mode",
              "dynamics", "actuator"},
    "sensor": {"sensor_type", "Hz", "location", "rotation", "configuration"},
    "dynamics": {"rho", "mass", "length", "diam", "r_bg", "r_bb", "area_fraction", "zeta_roll", "zeta_pitch", "T_yaw", "r44", "Cd"},
    "actuator": {"fin_count", "fin_offset_deg", "fin_center", "fin_area", "x_fin", "CL_delta", "deltaMax_fin_deg", "T_delta", "nMax",
                 "T_n", "D_prop", "KT_0", "KT_max", "KQ_0", "KQ_max", "w", "t_prop", "Ja_max"},
    "DynamicsSensor": {"UseCOM", "UseRPY"},
    "IMUSensor": {"AccelSigma", "AngVelSigma"},
    "DepthSensor": {"Sigma"},
    "GPSSensor": {"Sigma", "Depth"},
    "MagnetometerSensor": {"Sigma", "MagneticVector"},
}
# Stonefish: "Environment", "Robots", "Dynamic bodies", "Sensors", "Actuators".
STONEFISH = {
    "scenario": ({"environment", "robot"}, set()),
    "environment": ({"ocean"}, set()),
    "ocean": ({"current"}, set()),
    "current": ({"velocity"}, {"type"}),
    "velocity": (set(), {"xyz"}),
    "robot": ({"base_link", "sensor", "actuator"}, {"name"}),
    "base_link": ({"mass"}, {"name"}),
    "mass": (set(), {"value"}),
    "sensor": ({"noise", "origin"}, {"name", "type"}),
    "noise": (set(), {"ned_position", "heading", "angle"}),
    "origin": (set(), {"xyz", "rpy"}),
    "actuator": ({"specs", "thrust_model", "origin"}, {"name", "type"}),
    "specs": (set(), {"lift_coeff", "area", "max_angle"}),
    "thrust_model": ({"thrust_coeff"}, {"type"}),
    "thrust_coeff": (set(), {"forward", "reverse"}),
}
DEGREE = math.pi / 180


def library(navcal):
    """{effect: [parameters]}, from the first table of the program's list; another one is of parts of layouts."""
    rows = subprocess.run([navcal, "simulate", "--list-effects"], check=True, capture_output=True, text=True).stdout.splitlines()[2:]
    rows = list(itertools.takewhile(lambda row: row.startswith("|"), rows))
    cells = [[cell.strip() for cell in row.strip("|").split("|")] for row in rows]
    return {row[0]: row[2].split() for row in cells}


def value_of(effect, number):
    """A made-up size of the effect's parameter `number`, within every simulator's reach."""
    if effect in ("compass_lag", "gps_latency"):
        return 0.237
    size = 0.03 + 0.011 * number
    return size if "tau" in effect or effect.endswith(("lag", "latency", "backlash")) else size * (-1) ** number


def read_parm(text):
    """{name: value} as ArduPilot and pymavlink read it."""
    values = {}
    for line in text.splitlines():
        assert len(line.encode()) < 98, line
        if not line or line.startswith("#"):
            continue
        name, value = line.split()
        assert len(name) <= 16 and name not in values, name
        assert name in SITL_SCALARS or re.sub("_[XYZ]$", "", name) in SITL_VECTORS, name
        values[name] = float(value)
        assert name not in SITL_WHOLE or values[name].is_integer(), line
    return values


def read_scenario(text):
    """The scenario, with only keys that HoloOcean has."""
    scenario = json.loads(text)
    assert set(scenario) == HOLOOCEAN["scenario"] | {"navcal"}, set(scenario)
    (agent,) = scenario["agents"]
    assert set(agent) == HOLOOCEAN["agent"], set(agent)
    for part in ("dynamics", "actuator"):
        assert set(agent[part]) == HOLOOCEAN[part], part
    for sensor in agent["sensors"]:
        assert set(sensor) <= HOLOOCEAN["sensor"], sensor
        assert set(sensor["configuration"]) <= HOLOOCEAN[sensor["sensor_type"]], sensor
    return scenario


def read_xml(text):
    """The root, with only elements and attributes that Stonefish has."""
    root = ElementTree.fromstring(text)
    assert root.tag == "scenario"
    for element in root.iter():
        children, attributes = STONEFISH[element.tag]
        assert {child.tag for child in element} <= children and set(element.attrib) <= attributes, element.tag
    return root


def numbers(text):
    return [float(word) for word in text.split()]


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def rotation(roll, pitch, yaw):
    """Rz(yaw) Ry(pitch) Rx(roll)."""
    x = [[1, 0, 0], [0, math.cos(roll), -math.sin(roll)], [0, math.sin(roll), math.cos(roll)]]
    y = [[math.cos(pitch), 0, math.sin(pitch)], [0, 1, 0], [-math.sin(pitch), 0, math.cos(pitch)]]
    z = [[math.cos(yaw), -math.sin(yaw), 0], [math.sin(yaw), math.cos(yaw), 0], [0, 0, 1]]
    return product(z, product(y, x))


def rotation_vector(R):
    angle = math.acos(max(-1, min(1, (R[0][0] + R[1][1] + R[2][2] - 1) / 2)))
    axis = [R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]]
    return [angle * a / (2 * math.sin(angle)) for a in axis]


def inverse(m):
    """Of a 3 x 3 matrix, by cofactors."""
    cofactor = lambda i, j: (m[(i + 1) % 3][(j + 1) % 3] * m[(i + 2) % 3][(j + 2) % 3]
                             - m[(i + 1) % 3][(j + 2) % 3] * m[(i + 2) % 3][(j + 1) % 3])
    determinant = sum(m[0][j] * cofactor(0, j) for j in range(3))
    return [[cofactor(j, i) / determinant for j in range(3)] for i in range(3)]


def from_sitl(values):
    """{(effect, parameter): value} of a parameter file."""
    found = {}
    vector = lambda name: [values[f"{name}_{axis}"] for axis in "XYZ"]
    equal = lambda pattern, count: all(vector(pattern.format(n)) == vector(pattern.format(1)) for n in range(2, count + 1))
    if "SIM_MAG1_OFS_X" in values:
        assert equal("SIM_MAG{}_OFS", 3)
        found |= {("hard_iron", f"{axis}_uT"): -v / 10 for axis, v in zip("xyz", vector("SIM_MAG1_OFS"))}
    iron = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    if "SIM_MAG1_DIA_X" in values:
        assert equal("SIM_MAG{}_DIA", 3) and equal("SIM_MAG{}_ODI", 3)
        d, o = vector("SIM_MAG1_DIA"), vector("SIM_MAG1_ODI")
        iron = inverse([[d[0], o[0], o[1]], [o[0], d[1], o[2]], [o[1], o[2], d[2]]])
        found |= {("soft_iron", "xyz"[i] + "xyz"[j]): iron[i][j] - (i == j) for i in range(3) for j in range(i, 3)}
    if "SIM_MAG_MOT_X" in values:  # after the soft iron
        slope = [sum(iron[i][k] * vector("SIM_MAG_MOT")[k] for k in range(3)) / 10 for i in range(3)]
        found |= {("motor_field", f"{axis}_uT_per_A"): v for axis, v in zip("xyz", slope)}
    if "SIM_MAG_ALY_X" in values:
        assert values["SIM_MAG_ALY_HGT"] >= 1e5
        change = vector("SIM_MAG_ALY")
        assert change[2] == 0
        turned = cmath.phase(complex(FIELD_UT[0] + change[0] / 10, FIELD_UT[1] + change[1] / 10))
        found["declination", "angle_deg"] = (turned - cmath.phase(complex(*FIELD_UT[:2]))) / DEGREE
    if "SIM_MAG_DELAY" in values:
        found["compass_lag", "tau_s"] = values["SIM_MAG_DELAY"] / 1000
    if "SIM_GYR1_SCALE_X" in values:
        a, b = vector("SIM_GYR1_SCALE"), vector("SIM_GYR2_SCALE")
        assert a[:2] == b[:2]
        found |= {("gyro_scale", f"scale_{c}"): v / 100 for c, v in zip(("ax", "by", "az", "bz"), a + b[2:])}
    if "SIM_IMUT1_GYR1_X" in values:
        for n in (1, 2):
            assert values[f"SIM_IMUT{n}_ENABLE"] == 1 and values[f"SIM_IMUT{n}_TMIN"] + values[f"SIM_IMUT{n}_TMAX"] == 30
        assert values["SIM_IMUT_START"] == 15 and values["SIM_IMUT_END"] == 23 and values["SIM_IMUT_TCONST"] == 200
        a, b = vector("SIM_IMUT1_GYR1"), vector("SIM_IMUT2_GYR1")
        assert a[:2] == b[:2]
        found |= {("gyro_temperature", f"deg_per_s_per_C_{c}"): v * 1e-6 / DEGREE
                  for c, v in zip(("ax", "by", "az", "bz"), a + b[2:])}
    if "SIM_ACC1_BIAS_X" in values:
        assert equal("SIM_ACC{}_BIAS", 2)
        found |= {("accel_bias", f"{axis}_m_s2"): v for axis, v in zip("xyz", vector("SIM_ACC1_BIAS"))}
    if "SIM_ACC1_SCAL_X" in values:
        assert equal("SIM_ACC{}_SCAL", 2)
        found |= {("accel_scale", axis): 1 / v - 1 for axis, v in zip("xyz", vector("SIM_ACC1_SCAL"))}
    if "SIM_GPS1_LAG_MS" in values:
        found["gps_latency", "tau_s"] = (values["SIM_GPS1_LAG_MS"] - 100) / 1000
    if "SIM_GPS1_POS_X" in values:
        found |= {("gps_lever_arm", "x_m"): values["SIM_GPS1_POS_X"], ("gps_lever_arm", "y_m"): values["SIM_GPS1_POS_Y"]}
    if "SIM_WIND_SPD" in values:  # it comes from there
        assert values["SIM_WIND_T"] == 1 and 0 <= values["SIM_WIND_DIR"] < 360
        water = cmath.rect(-values["SIM_WIND_SPD"], values["SIM_WIND_DIR"] * DEGREE)
        found |= {("water_current", "north_m_s"): water.real, ("water_current", "east_m_s"): water.imag}
    if "SIM_BUOYANCY" in values:
        found["buoyancy", "force_N"] = values["SIM_BUOYANCY"]
    return found


# The reference vehicle (docs/simulator.md).
KT0, KT1, LIFT, FIN_LAG, YAW_DAMPING, MASS, GRAVITY = 0.35, -0.32, 3.0, 0.15, 0.15, 5.3, 9.81


def from_holoocean(scenario):
    found = {}
    (agent,) = scenario["agents"]
    sensors = {sensor["sensor_type"]: sensor for sensor in agent["sensors"]}
    compass, gps, actuator = sensors["MagnetometerSensor"], sensors["GPSSensor"], agent["actuator"]
    if "rotation" in compass:
        v = rotation_vector(rotation(*(angle * DEGREE for angle in compass["rotation"])))
        found |= {("compass_misalignment", f"{axis}_deg"): sign * a / DEGREE for axis, sign, a in zip("xyz", (1, -1, -1), v)}
    north, west, up = compass["configuration"]["MagneticVector"]
    assert abs(up + FIELD_UT[2]) < 1e-9
    found["declination", "angle_deg"] = (cmath.phase(complex(north, -west)) - cmath.phase(complex(*FIELD_UT[:2]))) / DEGREE
    if "location" in gps:
        x, y, z = gps["location"]
        assert z == 0
        found |= {("gps_lever_arm", "x_m"): x, ("gps_lever_arm", "y_m"): -y}
    found["thrust_scale", "scale"] = actuator["KT_0"] / KT0 - 1
    assert abs(actuator["KT_max"] - (KT0 + KT1 * actuator["Ja_max"]) * actuator["KT_0"] / KT0) < 1e-9
    found["fin_gain", "scale"] = actuator["CL_delta"] / LIFT - 1
    found["fin_lag", "tau_s"] = actuator["T_delta"] - FIN_LAG
    found["yaw_damping", "per_s"] = 1 / agent["dynamics"]["T_yaw"] - YAW_DAMPING
    return {key: value for key, value in found.items() if abs(value) > 1e-9}


def from_stonefish(root, wanted):
    """`wanted`: declination and misalignment both turn the compass, so that the former is taken off."""
    found = {}
    current = root.find("environment/ocean/current")
    if current is not None:
        assert current.get("type") == "uniform"
        north, east, down = numbers(current.find("velocity").get("xyz"))
        assert down == 0
        found |= {("water_current", "north_m_s"): north, ("water_current", "east_m_s"): east}
    mass = root.find("robot/base_link/mass")
    if mass is not None:
        found["buoyancy", "force_N"] = (MASS - float(mass.get("value"))) * GRAVITY
    origin = {sensor.get("type"): sensor.find("origin") for sensor in root.iter("sensor")}
    if "gps" in origin:
        x, y, z = numbers(origin["gps"].get("xyz"))
        assert z == 0
        found |= {("gps_lever_arm", "x_m"): x, ("gps_lever_arm", "y_m"): y}
    if "compass" in origin:
        roll, pitch, yaw = numbers(origin["compass"].get("rpy"))
        assert roll == pitch == 0
        declination = wanted.get(("declination", "angle_deg"))
        if declination is not None:
            found["declination", "angle_deg"] = declination
        misalignment = yaw / DEGREE + (declination or 0)
        if abs(misalignment) > 1e-9:
            found["compass_misalignment", "z_deg"] = misalignment
    if "imu" in origin:
        roll, pitch, yaw = numbers(origin["imu"].get("rpy"))
        assert yaw == 0
        found |= {("tilt_offset", "roll_deg"): roll / DEGREE, ("tilt_offset", "pitch_deg"): pitch / DEGREE}
    thrust = root.find("robot/actuator/thrust_model/thrust_coeff")
    if thrust is not None:
        found["thrust_scale", "scale"] = float(thrust.get("forward")) / KT0 - 1
    rudders = [actuator for actuator in root.iter("actuator") if actuator.get("type") == "rudder"]
    if rudders:
        found |= from_rudders(rudders)
    return found


def from_rudders(rudders):
    """Gain, rudder and elevator of three fins; each one's force must act along the normal of the reference vehicle."""
    assert len(rudders) == 3
    gains, offsets = [], []
    for rudder, span in zip(rudders, ((0, -1), (math.sqrt(0.75), 0.5), (-math.sqrt(0.75), 0.5))):
        gains.append(float(rudder.find("specs").get("lift_coeff")) / LIFT - 1)
        place = numbers(rudder.find("origin").get("xyz"))
        assert all(abs(a - b) < 1e-9 for a, b in zip(place, (-0.40, 0.085 * span[0], 0.085 * span[1])))
        R = rotation(*numbers(rudder.find("origin").get("rpy")))
        normal = (0, -span[1], span[0])
        assert all(abs(R[i][2] + (0, *span)[i]) < 1e-9 for i in range(3)), "the shaft lies along the fin"
        offsets.append(math.atan2(sum(R[i][0] * normal[i] for i in range(3)), R[0][0]) / DEGREE)
    assert max(gains) - min(gains) < 1e-12
    found = {("fin_gain", "scale"): gains[0], ("fin_offset", "angle_deg"): -offsets[0],
             ("elevator_offset", "angle_deg"): (offsets[1] - offsets[2]) / math.sqrt(3)}
    assert abs(offsets[1] + offsets[2] + offsets[0]) < 1e-9
    return {key: value for key, value in found.items() if abs(value) > 1e-9}


def export(navcal, folder, effects, verdict="explained"):
    """The three files of a diagnosis with these effects: {simulator: text}."""
    found = [{"name": name, "probability": 0.98, "parameters": parameters, "std_errors": {key: 0.001 for key in parameters},
              "confused_with": []} for name, parameters in effects.items()]
    diagnosis = {"verdict": verdict, "sentence": "Made up.", "effects": found, "field": {"north_east_down_uT": FIELD_UT}}
    source = os.path.join(folder, "found.json")
    with open(source, "w") as file:
        json.dump(diagnosis, file)
    files = {name: os.path.join(folder, name) for name in ("sitl", "holoocean", "stonefish")}
    command = [navcal, "gap", "--from", source, "--overwrite"]
    for name, path in files.items():
        command += ["--export", f"{name}={path}"]
    subprocess.run(command, check=True, capture_output=True)
    return {name: open(path).read() for name, path in files.items()}


def read_back(texts, wanted):
    return {"sitl": from_sitl(read_parm(texts["sitl"])), "holoocean": from_holoocean(read_scenario(texts["holoocean"])),
            "stonefish": from_stonefish(read_xml(texts["stonefish"]), wanted)}


def left_out(text):
    """{effect: reason} of a file's comments, which are wrapped."""
    plain = " ".join(re.sub(r"(?m)^\s*#|<!--|-->|^\s*\"", " ", text).split())
    return dict(re.findall(r"Left out: (\w+): ([^.]{10,}?)\.", plain))


def check(navcal, folder, effects):
    wanted = {(name, parameter): value for name, values in effects.items() for parameter, value in values.items()}
    texts = export(navcal, folder, effects)
    count = 0
    for simulator, found in read_back(texts, wanted).items():
        reasons = left_out(texts[simulator])
        for key, value in found.items():
            tolerance = 5e-4 if key in (("compass_lag", "tau_s"), ("gps_latency", "tau_s")) and simulator == "sitl" else 1e-6
            assert abs(value - wanted[key]) <= tolerance, (simulator, key, value, wanted[key])
            count += 1
        for name in effects:
            carried = any(key[0] == name for key in found)
            assert carried != (name in reasons), (simulator, name, "neither carried nor left out, or both")
    return count


def main(navcal):
    effects = {name: {parameter: value_of(name, i) for i, parameter in enumerate(parameters)}
               for name, parameters in library(navcal).items()}
    with tempfile.TemporaryDirectory() as folder:
        count = sum(check(navcal, folder, {name: values}) for name, values in effects.items())
        count += check(navcal, folder, effects)  # soft iron and motor's field, rudder and elevator act together
        for verdict in ("no-gap", "unknown"):
            texts = export(navcal, folder, effects, verdict)
            assert not any(read_back(texts, {}).values())
            assert all("no correction" in text for text in texts.values())
    assert count > 80, count
    print(f"{len(effects)} effects, {count} numbers read back")


main(sys.argv[1])
