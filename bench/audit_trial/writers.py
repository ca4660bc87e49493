# SPDX-License-Identifier: Apache-2.0
"""Logs of four kinds, from samples in SI units: a capture of navcal with lines of injected samples, ArduPilot DataFlash,
PX4 ULog and a MAVLink telemetry log.

A log is {port: [Sample]}. The kind of a port is its name without a number: compass, imu, gps, depth, dvl, attitude,
motor. Each port's samples stand in the order in which they came; times may go back within it.
"""
import dataclasses
import json
import math
import struct

LATENCY_S = {"compass": 0.02, "imu": 0.01, "gps": 0.2, "depth": 0.02, "dvl": 0.1, "attitude": 0.005, "motor": 0.005}
CLASSES = {"compass": "COMPASS", "imu": "IMU", "gps": "GPS", "depth": "DEPTH", "dvl": "DVL", "attitude": "COMPASS",
           "motor": "MOTOR"}
GPS_EPOCH_S, LEAP_S, WEEK_S = 315964800, 18, 604800
BOOT_S = 5.0  # the autopilot had run that long at the first sample


@dataclasses.dataclass
class Sample:
    time_s: float  # of validity, UTC, as the log states it
    arrival_s: float  # the place in the file
    values: dict


def kind_of(port):
    return port.rstrip("0123456789")


def number_of(port):
    digits = port[len(kind_of(port)):]
    return int(digits) - 1 if digits else 0


def in_order(log):
    """(port, sample) by arrival; samples of one port keep their order."""
    rows = [(sample.arrival_s, port, i, sample) for port, samples in log.items() for i, sample in enumerate(samples)]
    return [(port, sample) for _, port, _, sample in sorted(rows, key=lambda row: row[:3])]


def write_capture(file, log):
    lines = ["#capture 1"] + [f"#port {port} samples 115200" for port in log]
    for port, sample in in_order(log):
        line = {"class": CLASSES[kind_of(port)], "time": round(sample.time_s, 9), **sample.values}
        data = json.dumps(line).encode() + b"\n"
        lines.append(f"{sample.arrival_s:.9f} {port} < {data.hex()}")
    file.write_text("\n".join(lines) + "\n")


def horizontal(values):
    """Speed and course in degrees."""
    return values.get("speed_m_s") or 0.0, math.degrees(values.get("course_rad") or 0.0) % 360


class DataFlash:
    """https://ardupilot.org/dev/docs/code-overview-adding-a-new-log-message.html; units as ArduPilot's usual ones."""

    FORMATS = {  # name: (type, letters, columns)
        "FMT": (128, "BBnNZ", "Type,Length,Name,Format,Columns"),
        "PARM": (129, "QNf", "TimeUS,Name,Value"),
        "MSG": (130, "QZ", "TimeUS,Message"),
        "IMU": (131, "QBffffff", "TimeUS,I,GyrX,GyrY,GyrZ,AccX,AccY,AccZ"),
        "MAG": (132, "QBhhhB", "TimeUS,I,MagX,MagY,MagZ,Health"),
        "BARO": (133, "QBffc", "TimeUS,I,Alt,Press,Temp"),
        "GPS": (134, "QBBIHBcLLefff", "TimeUS,I,Status,GMS,GWk,NSats,HDop,Lat,Lng,Alt,Spd,GCrs,VZ"),
        "ATT": (135, "Qccc", "TimeUS,Roll,Pitch,Yaw"),
        "BAT": (136, "QBff", "TimeUS,Instance,Volt,Curr"),
    }
    STRUCT = dict(B="B", h="h", H="H", I="I", f="f", n="4s", N="16s", Z="64s", c="h", e="i", L="i", Q="Q")

    def __init__(self):
        self.out = bytearray()
        for name, (kind, letters, columns) in self.FORMATS.items():
            self.add("FMT", kind, 3 + struct.calcsize(self.layout(letters)), name.encode(), letters.encode(),
                     columns.encode())

    def layout(self, letters):
        return "<" + "".join(self.STRUCT[letter] for letter in letters)

    def add(self, name, *values):
        kind, letters, _ = self.FORMATS[name]
        self.out += struct.pack("<BBB", 0xA3, 0x95, kind) + struct.pack(self.layout(letters), *values)


def centi(value):
    return round(100 * value)


def write_dataflash(file, log, parameters=None):
    flash = DataFlash()
    rows = in_order(log)
    zero_s = rows[0][1].time_s - BOOT_S
    flash.add("MSG", 1000, b"ArduSub V4.1.2")
    for name, value in (parameters or {"BARO_PRIMARY": 0.0}).items():
        flash.add("PARM", 1000, name.encode(), value)
    for port, sample in rows:
        kind, i, values = kind_of(port), number_of(port), sample.values
        us = max(round(1e6 * (sample.time_s - zero_s)), 0)
        if kind == "imu":
            flash.add("IMU", us, i, *values["rate_rad_s"], *values["specific_force_m_s2"])
        elif kind == "compass":
            flash.add("MAG", us, i, *(round(10 * axis) for axis in values["field_body_uT"]), 1)
        elif kind == "depth":
            flash.add("BARO", us, 0, -values["depth_m"], 101325 + 10052 * values["depth_m"], 1200)
        elif kind == "attitude":
            flash.add("ATT", us, centi(math.degrees(values["roll_rad"])), centi(math.degrees(values["pitch_rad"])),
                      centi((math.degrees(values["heading_rad"]) + 180) % 360 - 180))
        elif kind == "motor":
            flash.add("BAT", us, 0, 15.6, values["current_A"])
        elif kind == "gps":
            week, of_week = divmod(sample.time_s - GPS_EPOCH_S + LEAP_S, WEEK_S)
            speed, course = horizontal(values)
            has_fix = values.get("lat") is not None
            flash.add("GPS", us, 0, 3 if has_fix else 1, round(1000 * of_week), int(week), 9, 90,
                      round(1e7 * (values.get("lat") or 0)), round(1e7 * (values.get("lon") or 0)), 0, speed, course, 0.0)
    file.write_bytes(flash.out)


def quaternion(roll, pitch, yaw):
    cr, sr, cp, sp, cy, sy = (f(angle / 2) for angle in (roll, pitch, yaw) for f in (math.cos, math.sin))
    return (cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy)


class ULog:
    """https://docs.px4.io/main/en/dev_log/ulog_file_format.html"""

    FORMATS = {
        "sensor_combined": ("uint64_t timestamp;float[3] gyro_rad;float[3] accelerometer_m_s2;", "6f"),
        "vehicle_magnetometer": ("uint64_t timestamp;float[3] magnetometer_ga;", "3f"),
        "vehicle_gps_position": ("uint64_t timestamp;uint64_t time_utc_usec;int32_t lat;int32_t lon;int32_t alt;"
                                 "float vel_m_s;float cog_rad;uint8_t fix_type;uint8_t satellites_used;", "QiiiffBB"),
        "vehicle_attitude": ("uint64_t timestamp;float[4] q;", "4f"),
        "battery_status": ("uint64_t timestamp;float voltage_v;float current_a;", "2f"),
    }

    def __init__(self, streams):
        self.out = bytearray(b"ULog\x01\x12\x35\x01" + struct.pack("<Q", 1000000))
        self.message("B", bytes(40))
        for name, (members, _) in self.FORMATS.items():
            self.message("F", f"{name}:{members}".encode())
        for number, (name, instance) in enumerate(streams):
            self.message("A", struct.pack("<BH", instance, number) + name.encode())

    def message(self, kind, content):
        self.out += struct.pack("<HB", len(content), ord(kind)) + content

    def data(self, number, name, us, *values):
        self.message("D", struct.pack("<HQ" + self.FORMATS[name][1], number, us, *values))


ULOG_NAMES = {"imu": "sensor_combined", "compass": "vehicle_magnetometer", "gps": "vehicle_gps_position",
              "attitude": "vehicle_attitude", "motor": "battery_status"}


def write_ulog(file, log):
    streams = [(ULOG_NAMES[kind_of(port)], number_of(port)) for port in log if kind_of(port) in ULOG_NAMES]
    ulog = ULog(streams)
    rows = in_order(log)
    zero_s = rows[0][1].time_s - BOOT_S
    for port, sample in rows:
        kind, values = kind_of(port), sample.values
        if kind not in ULOG_NAMES:
            continue
        name = ULOG_NAMES[kind]
        us, number = max(round(1e6 * (sample.time_s - zero_s)), 0), streams.index((name, number_of(port)))
        if kind == "imu":
            ulog.data(number, name, us, *values["rate_rad_s"], *values["specific_force_m_s2"])
        elif kind == "compass":
            ulog.data(number, name, us, *(axis / 100 for axis in values["field_body_uT"]))
        elif kind == "attitude":
            ulog.data(number, name, us, *quaternion(values["roll_rad"], values["pitch_rad"], values["heading_rad"]))
        elif kind == "motor":
            ulog.data(number, name, us, 15.6, values["current_A"])
        elif kind == "gps":
            speed, course = horizontal(values)
            has_fix = values.get("lat") is not None
            ulog.data(number, name, us, round(1e6 * sample.time_s), round(1e7 * (values.get("lat") or 0)),
                      round(1e7 * (values.get("lon") or 0)), 0, speed, math.radians(course), 3 if has_fix else 1, 9)
    file.write_bytes(ulog.out)


def crc_x25(data):
    crc = 0xFFFF
    for byte in data:
        byte ^= crc & 0xFF
        byte ^= (byte << 4) & 0xFF
        crc = (crc >> 8) ^ (byte << 8) ^ (byte << 3) ^ (byte >> 4)
    return crc


def write_tlog(file, log):
    out = bytearray()
    count = 0

    def add(time_s, message, crc_extra, layout, *values):
        nonlocal count
        payload = struct.pack("<" + layout, *values)
        body = struct.pack("<BBBBB", len(payload), count % 256, 1, 1, message) + payload
        out.extend(struct.pack(">Q", round(1e6 * time_s)) + b"\xfe" + body + struct.pack("<H", crc_x25(body + bytes([crc_extra]))))
        count += 1

    def short(value):
        return max(-32768, min(32767, round(value)))

    rows = in_order(log)
    zero_s = rows[0][1].time_s - BOOT_S
    fields, pulse_s = {}, -math.inf
    for port, sample in rows:
        kind, i, values, time_s = kind_of(port), number_of(port), sample.values, sample.time_s
        ms = max(round(1000 * (time_s - zero_s)), 0)
        if sample.arrival_s > pulse_s + 1:
            pulse_s = sample.arrival_s
            add(time_s, 0, 50, "IBBBBB", 0, 12, 3, 0, 4, 3)
        if kind == "compass":
            fields[i] = [short(10 * axis) for axis in values["field_body_uT"]]
        elif kind == "imu":
            rates = [short(1000 * axis) for axis in values["rate_rad_s"]]
            forces = [short(axis / 9.80665e-3) for axis in values["specific_force_m_s2"]]
            for unit, field in (fields or {0: [0, 0, 0]}).items():
                add(time_s, (26, 116)[unit], (170, 76)[unit], "I9h", ms, *forces, *rates, *field)
        elif kind == "attitude":
            heading = math.remainder(values["heading_rad"], 2 * math.pi)
            add(time_s, 30, 39, "I6f", ms, values["roll_rad"], values["pitch_rad"], heading, 0, 0, 0)
        elif kind == "depth":
            add(time_s, 29, 115, "Iffh", ms, 1013.25 + 100.52 * values["depth_m"], 0.0, 1200)
        elif kind == "gps":
            speed, course = horizontal(values)
            has_fix = values.get("lat") is not None
            add(time_s, 24, 24, "QiiiHHHHBB", round(1e6 * (time_s - zero_s)), round(1e7 * (values.get("lat") or 0)),
                round(1e7 * (values.get("lon") or 0)), 0, 90, 65535, round(100 * speed), round(100 * course) % 36000,
                3 if has_fix else 1, 9)
    file.write_bytes(out)


WRITERS = {"capture": (".cap", write_capture), "dataflash": (".BIN", write_dataflash), "ulog": (".ulg", write_ulog),
           "tlog": (".tlog", write_tlog)}
