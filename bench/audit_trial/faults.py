# SPDX-License-Identifier: Apache-2.0
"""Faults at three sizes. Each states the finding that names it, and the value of that finding that is true.

`effects` makes a fault in the simulator, `plant` in the samples before they are written. `also` are findings that the
fault makes true beside its own: a compass with iron states a wrong heading, too.
"""
import dataclasses
import math

from writers import Sample

ALL = ("capture", "dataflash", "ulog", "tlog")
OWN_TIMES = ("capture", "dataflash", "ulog")  # in a telemetry log the field comes with the rates
ITS_HEADING = "compass.heading"


@dataclasses.dataclass
class Fault:
    name: str
    group: str  # two faults of a case come from two groups
    finds: tuple  # names of the findings that state it
    sizes: tuple
    effects: object = None  # (size, dice, truth before effects) -> text
    plant: object = None  # (log, size, dice, truth) -> value of the finding, or None
    value: object = None  # (size, made, truth) -> the same, for effects
    also: tuple = ()
    also_likely: tuple = ()  # true of the log where they are called likely: their text names this fault
    forms: tuple = ALL
    needs: tuple = ()  # "reference", "dvl", "pair", "declination"


def direction(dice, level=0.0):
    angle = dice.uniform(0, 2 * math.pi)
    down = dice.uniform(-level, level)
    return math.cos(angle) * math.cos(down), math.sin(angle) * math.cos(down), math.sin(down)


def toml(name, **values):
    return f"[{name}]\n" + "".join(f"{key} = {value:.6f}\n" for key, value in values.items())


# Effects of the simulator: (text, made), made for the true value.

def hard_iron(size_deg, dice, horizontal_uT):
    b = [horizontal_uT * math.sin(math.radians(size_deg)) * axis for axis in direction(dice, 0.5)]
    return toml("hard_iron", x_uT=b[0], y_uT=b[1], z_uT=b[2]), b


def iron_value(_, b, truth):
    return truth.worst_heading_deg(lambda m: [m[i] + b[i] for i in range(3)])


def soft_iron(size, dice, _):
    angle = dice.uniform(0, math.pi)
    s = dict(xx=size * math.cos(2 * angle), yy=-size * math.cos(2 * angle), zz=0, xy=size * math.sin(2 * angle), xz=0, yz=0)
    return toml("soft_iron", **s), s


def soft_value(_, s, truth):
    return truth.worst_heading_deg(lambda m: [(1 + s["xx"]) * m[0] + s["xy"] * m[1], s["xy"] * m[0] + (1 + s["yy"]) * m[1], m[2]])


def motor_field(size, dice, _):
    k = [size * axis for axis in direction(dice, 0.4)]
    return toml("motor_field", x_uT_per_A=k[0], y_uT_per_A=k[1], z_uT_per_A=k[2]), k


def field_step(size_uT, dice, _):
    b = [size_uT * axis for axis in direction(dice, 0.5)]
    return toml("hard_iron", x_uT=b[0], y_uT=b[1], z_uT=b[2], from_s=dice.uniform(150, 270)), b


def gyro_scale(size, dice, _):
    k = size * dice.choice((-1, 1))
    return toml("gyro_scale", scale_ax=0, scale_az=k, scale_by=0, scale_bz=0), k


# Faults of the writer.

def gyro_bias(log, size, dice, _):
    bias = size * dice.choice((-1, 1))
    for sample in log["imu"]:
        sample.values["rate_rad_s"][2] += math.radians(bias)
    return bias


def gyro_sign(log, size, _dice, _truth):
    axes = {1: (2,), 2: (1, 2), 3: (0, 1, 2)}[size]
    for sample in log["imu"]:
        for axis in axes:
            sample.values["rate_rad_s"][axis] *= -1


def gyro_unit(log, size, _dice, _truth):
    for sample in log["imu"]:
        sample.values["rate_rad_s"] = [math.degrees(axis) for axis in sample.values["rate_rad_s"]]


def delayed(port):
    def plant(log, size, _dice, _truth):
        for sample in log[port]:
            sample.time_s += size
            sample.arrival_s += size
        return size
    return plant


def depth_offset(log, size, dice, truth):
    offset = size * dice.choice((-1, 1))
    for sample in log["depth"] if "depth" in log else log["imu"]:
        sample.values["depth_m"] += offset
    return offset + surface_depth(log, truth)


def surface_depth(log, truth):
    depths = [truth.z[truth.index(s.time_s)] for s in log["gps"] if s.values.get("lat") is not None]
    return sum(depths) / len(depths) if depths else None


def gps_jump(log, size_m, dice, _):
    fixes = [i for i, s in enumerate(log["gps"]) if s.values.get("fix") == "3d"]
    whole = [i for i in fixes if i - 1 in fixes and i + 1 in fixes]
    for i in dice.sample(whole, min(3, len(whole))):
        log["gps"][i].values["lat"] += size_m / 111200 * dice.choice((-1, 1))


def dvl_scale(log, size, dice, _):
    k = size * dice.choice((-1, 1))
    for sample in log["dvl"]:
        if "bottom_velocity_m_s" in sample.values:
            sample.values["bottom_velocity_m_s"] = [(1 + k) * axis for axis in sample.values["bottom_velocity_m_s"]]
    return 1 / (1 + k)


def dvl_zeros(log, size, dice, _):
    zeros = 0
    for sample in log["dvl"]:
        if "bottom_velocity_m_s" in sample.values and dice.random() < size / 100:
            sample.values["bottom_velocity_m_s"] = [0.0, 0.0, 0.0]
            zeros += 1
    return 100 * zeros / len(log["dvl"])


def lost_samples(log, size, dice, _):
    port = dice.choice(("compass", "imu"))
    count = len(log[port])
    log[port] = [s for s in log[port] if dice.random() >= size / 100]
    return 100 * (1 - len(log[port]) / count)


def vectors_of(port):
    return ("field_body_uT",) if port.startswith("compass") else ("rate_rad_s", "specific_force_m_s2")


def repeated(log, size, dice, _):
    port = dice.choice(("compass", "imu"))
    count = 0
    for before, sample in zip(log[port], log[port][1:]):
        if dice.random() < size / 100:
            count += 1
            for key in vectors_of(port):
                sample.values[key] = list(before.values[key])
    return 100 * count / len(log[port])


def frozen(log, size_s, dice, truth):
    port = dice.choice(("compass", "imu"))
    begin_s = truth.begin_s + dice.uniform(100, 300)
    held = None
    for sample in log[port]:
        if begin_s <= sample.time_s < begin_s + size_s:
            held = held or {key: list(sample.values[key]) for key in vectors_of(port)}
            sample.values.update({key: list(value) for key, value in held.items()})


def disorder(log, size, dice, _):
    port = dice.choice(("compass", "imu"))
    count = 0
    for before, sample in zip(log[port][::2], log[port][1::2]):
        if dice.random() < size / 50:
            before.time_s, sample.time_s = sample.time_s, before.time_s
            count += 1
    return 100 * count / len(log[port])


def vibration(log, size, dice, _):
    for sample in log["imu"]:
        sample.values["specific_force_m_s2"] = [f + dice.gauss(0, size) for f in sample.values["specific_force_m_s2"]]


def clipping(log, size, dice, _):
    limit = 18 * size
    for sample in log["imu"]:
        sample.values["specific_force_m_s2"] = [max(-limit, min(limit, f + dice.gauss(0, 18)))
                                                for f in sample.values["specific_force_m_s2"]]


def heading_off(log, size, dice, _):
    """A deviation of an autopilot's own compass, constant and once around."""
    phase, constant = dice.uniform(0, 2 * math.pi), math.radians(size) * dice.uniform(-0.5, 0.5)
    swing = math.sqrt(2 * (math.radians(size) ** 2 - constant ** 2))
    squares = []
    for sample in log["attitude"]:
        error = constant + swing * math.sin(sample.values["heading_rad"] + phase)
        sample.values["heading_rad"] = (sample.values["heading_rad"] + error) % (2 * math.pi)
        squares.append(math.degrees(error) ** 2 + 0.3 ** 2)
    return math.sqrt(sum(squares) / len(squares))


def declination_twice(log, _size, _dice, truth):
    for sample in log["attitude"]:
        sample.values["heading_rad"] = (sample.values["heading_rad"] + truth.declination_rad) % (2 * math.pi)
    return math.hypot(math.degrees(truth.declination_rad), 0.3)


def compass_pair(log, size, dice, _):
    angle = math.radians(size) * dice.choice((-1, 1))
    c, s = math.cos(angle), math.sin(angle)
    for sample in log["compass2"]:
        x, y, z = sample.values["field_body_uT"]
        sample.values["field_body_uT"] = [c * x - s * y, s * x + c * y, z]
    return size


def field_unit(log, size, _dice, truth):
    for port in ("compass", "compass2"):
        for sample in log.get(port, ()):
            sample.values["field_body_uT"] = [size * axis for axis in sample.values["field_body_uT"]]
    return size * math.sqrt(sum(axis * axis for axis in truth.field_ned))


def field_axes(log, size, _dice, _truth):
    """Axes of another frame: forward, left, up; y reversed; x and y exchanged."""
    turn = {1: lambda x, y, z: [x, -y, -z], 2: lambda x, y, z: [x, -y, z], 3: lambda x, y, z: [y, x, z]}[size]
    for sample in log["compass"]:
        sample.values["field_body_uT"] = turn(*sample.values["field_body_uT"])


def rates_less(keys):
    return tuple(f"convention.{key}" for key in keys)


FAULTS = [
    Fault("hard iron", "compass", ("compass.iron",), (4, 10, 25), hard_iron, value=iron_value, also=(ITS_HEADING,)),
    Fault("soft iron", "compass", ("compass.iron",), (0.06, 0.12, 0.25), soft_iron, value=soft_value, also=(ITS_HEADING,)),
    Fault("field of the motor", "compass", ("compass.motor",), (0.5, 1, 2), motor_field,
          value=lambda size, k, truth: size, also=(ITS_HEADING,), also_likely=("compass.iron",),
          forms=("capture", "dataflash", "ulog"), needs=("reference",)),
    Fault("step of the field", "compass", ("compass.step",), (4, 8, 16), field_step,
          value=lambda size, b, truth: size, also=(ITS_HEADING, "compass.iron")),
    Fault("scale of the gyro", "gyro", ("gyro.scale",), (0.04, 0.08, 0.16), gyro_scale, value=lambda size, k, truth: 1 / (1 + k)),
    Fault("bias of the gyro", "gyro", ("gyro.bias", "gyro.rest"), (0.1, 0.3, 1), plant=gyro_bias),
    Fault("sign of the gyro", "gyro", rates_less(("sign", "body_frame")) + ("compass.axes",), (1, 2, 3), plant=gyro_sign,
          also=("gyro.scale", "convention.axis_swapped")),
    Fault("unit of the gyro", "gyro", rates_less(("degrees_for_radians",)), (1, 1, 1), plant=gyro_unit, also=("gyro.scale",),
          forms=("capture", "dataflash", "ulog")),
    Fault("late compass", "delay", ("delay.compass",), (0.15, 0.3, 0.6), plant=delayed("compass")),
    Fault("late receiver", "delay", ("delay.course",), (0.7, 1.4, 2.8), plant=delayed("gps")),
    Fault("offset of the depth", "depth", ("depth.surface",), (1, 2, 4), plant=depth_offset, forms=("capture", "dataflash")),
    Fault("jumps of the receiver", "gps", ("gps.jumps",), (60, 150, 500), plant=gps_jump),
    Fault("scale of the Doppler log", "dvl", ("dvl.scale",), (0.05, 0.1, 0.2), plant=dvl_scale, forms=("capture",), needs=("dvl",)),
    Fault("zeros of the Doppler log", "dvl", ("dvl.zeros",), (4, 12, 40), plant=dvl_zeros, also=("dvl.scale",),
          forms=("capture",), needs=("dvl",)),
    Fault("lost samples", "sampling", ("sampling.gaps",), (5, 9, 14), plant=lost_samples, also=("sampling.irregular",),
          forms=OWN_TIMES),
    Fault("repeated values", "sampling", ("sampling.repeated",), (30, 50, 70), plant=repeated,
          also=("delay.compass",), forms=OWN_TIMES),  # a reading that is repeated is late
    Fault("frozen values", "sampling", ("sampling.repeated",), (4, 8, 16), plant=frozen, forms=OWN_TIMES),
    Fault("times in disorder", "sampling", ("sampling.order",), (0.5, 1.5, 5), plant=disorder,
          also=("sampling.irregular", "sampling.gaps"), forms=OWN_TIMES),
    Fault("vibration", "force", ("force.vibration",), (40, 70, 120), plant=vibration),
    Fault("clipping", "force", ("force.clipping",), (1.2, 1.7, 2.2), plant=clipping, also=("force.vibration",)),
    Fault("heading off", "heading", (ITS_HEADING,), (5, 10, 20), plant=heading_off, forms=("dataflash", "ulog", "tlog")),
    Fault("declination twice", "heading", ("convention.declination_twice", ITS_HEADING), (1, 1, 1), plant=declination_twice,
          forms=("dataflash", "ulog", "tlog"), needs=("declination",)),
    Fault("two compasses apart", "pair", ("compass.pair",), (10, 20, 40), plant=compass_pair, needs=("pair",)),
    Fault("unit of the field", "compass", ("compass.size",), (10, 0.1, 0.01), plant=field_unit,
          also=("sampling.repeated", "sampling.gaps", "sampling.irregular")),  # the steps of the format hide changes
    Fault("axes of the field", "compass", ("compass.iron", "compass.axes", "convention.field"), (1, 2, 3), plant=field_axes, also=(ITS_HEADING, "compass.pair")),
]
BY_NAME = {fault.name: fault for fault in FAULTS}
