# SPDX-License-Identifier: Apache-2.0
"""The faults, one generator each: it spoils the line, yields the seconds that are to pass meanwhile, and mends it.

`case` has `line`, `rng` and `emulator` (whose console turns devices off and on).
"""
FAST_PERIOD_S = 0.005


def flip(data, rng, share):
    """Each byte has one bit flipped with the probability `share`."""
    spoilt = bytearray(data)
    for i in range(len(spoilt)):
        if rng.random() < share:
            spoilt[i] ^= 1 << rng.randrange(8)
    return bytes(spoilt)


def bit_flips(case):
    share = 10 ** case.rng.uniform(-2.5, -1)
    case.line.spoil = lambda data: [flip(data, case.rng, share)]
    yield case.rng.uniform(0.5, 2)
    case.line.spoil = None


def burst(case):
    """Noise between frames and within them: 1 to 600 bytes, put in or written over."""
    over = case.rng.random() < 0.5
    left = case.rng.randrange(1, 600)

    def spoil(data):
        nonlocal left
        noise = case.rng.randbytes(min(left, len(data)))
        left -= len(noise)
        return [noise + data[len(noise):]] if over else [noise, data]
    case.line.spoil = spoil
    yield case.rng.uniform(0.2, 1.2)
    case.line.spoil = None


def truncation(case):
    """Tails of what the device sends are lost."""
    case.line.spoil = lambda data: [data[:case.rng.randrange(len(data))] if case.rng.random() < 0.5 else data]
    yield case.rng.uniform(0.5, 2)
    case.line.spoil = None


def stall(case):
    """Nothing comes for up to two seconds, then all at once, as from a stalled adapter."""
    held = bytearray()
    case.line.spoil = lambda data: (held.extend(data), [])[1]
    yield case.rng.uniform(0.1, 2)
    case.line.spoil = None
    case.line.give(bytes(held))


def duplicated_reads(case):
    case.line.spoil = lambda data: [data, data] if case.rng.random() < 0.4 else [data]
    yield case.rng.uniform(0.5, 2)
    case.line.spoil = None


def reordered_reads(case):
    held = []

    def spoil(data):
        if held:
            return [data, held.pop()]
        if case.rng.random() < 0.4:
            held.append(data)
            return []
        return [data]
    case.line.spoil = spoil
    yield case.rng.uniform(0.5, 2)
    case.line.spoil = None
    for data in held:
        case.line.give(data)


def power_cycle(case):
    """The device begins anew in the middle of whatever it was saying."""
    case.emulator.tell(f"power-cycle {case.line.name}")
    yield 0.01


def hang_up(case):
    """Closed at the other end: EIO. The same path comes back."""
    if case.rng.random() < 0.5:
        case.line.spoil = lambda data: []
        yield 0.05  # the line is quiet when it is cut; otherwise bytes are on their way
    case.line.unplug()
    case.when_cut()
    yield 10 ** case.rng.uniform(-2, 0.3)
    case.line.spoil = None
    case.line.plug()


def reappearing(case):
    """Gone, and back under another name, as a USB adapter in another socket."""
    elsewhere = case.line.replug_elsewhere()
    case.when_cut()
    yield 10 ** case.rng.uniform(-2, 0.3)
    case.line.plug_prepared(elsewhere)


def wrong_speed(case):
    speeds = [s for s in (4800, 9600, 19200, 38400, 57600, 115200) if s != case.line.baud]
    case.line.listen_at(case.rng.choice(speeds))
    yield case.rng.uniform(0.5, 3)
    case.line.listen_at(case.line.baud)


def flood(case):
    """Ten times what the line can carry: what the device last said, over and over, with noise between."""
    said = bytes(case.line.said[-2048:]) or b"\0"
    step = int(case.line.baud / 10 * 10 * FAST_PERIOD_S)
    at = 0
    for _ in range(int(case.rng.uniform(0.3, 1) / FAST_PERIOD_S)):
        piece = (said + said)[at:at + step]
        at = (at + step) % len(said)
        case.line.give(piece if case.rng.random() < 0.9 else case.rng.randbytes(step))
        yield FAST_PERIOD_S


def replies_lost(case):
    """The dialogue of a start-up with half of its commands, or half of what comes back, lost."""
    case.line.unplug()
    case.when_cut()
    yield 0.05
    if case.rng.random() < 0.5:
        case.line.spoil_command = lambda data: b"" if case.rng.random() < 0.5 else data
    else:
        case.line.spoil = lambda data: [] if case.rng.random() < 0.5 else [data]
    case.line.plug()
    yield case.rng.uniform(1, 3)
    case.line.spoil = case.line.spoil_command = None


KINDS = {
    "bit flips": bit_flips, "noise bursts": burst, "truncation": truncation, "stall": stall,
    "duplicated reads": duplicated_reads, "reordered reads": reordered_reads, "device power cycle": power_cycle,
    "hang-up (EIO)": hang_up, "back under another name": reappearing, "wrong speed": wrong_speed,
    "flood, 10 times the line rate": flood, "commands or replies lost": replies_lost,
}
# Only these devices take commands.
ONLY_AT = {"commands or replies lost": ("compass", "gps")}
