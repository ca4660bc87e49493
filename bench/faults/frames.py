# SPDX-License-Identifier: Apache-2.0
"""Intact frames in a stream of bytes, found by the interface document (docs/icd.md) alone: no code shared with navcal."""
import re

TCM2_WORD = re.compile(rb"\$[CPRXYZTE][-.0-9][^$*\x00-\x1f]*\*([0-9A-Fa-f]{2})\r?\n")
MOTOR_LINE = re.compile(rb"\$MC[SC],[^$*\x00-\x1f]*\*([0-9A-Fa-f]{2})\r?\n")
ONCORE_BYTES = {b"Ea": 76, b"Ha": 154, b"Hb": 54, b"Ba": 68, b"Bb": 92, b"Bo": 8}
IMU_SYNC, IMU_BYTES = b"\xa5\x5a", 22

CRC_TABLE = []
for _byte in range(256):
    _crc = _byte << 8
    for _ in range(8):
        _crc = ((_crc << 1) ^ 0x1021 if _crc & 0x8000 else _crc << 1) & 0xFFFF
    CRC_TABLE.append(_crc)


def crc16(data):
    """CRC-16/CCITT-FALSE."""
    crc = 0xFFFF
    for byte in data:
        crc = ((crc << 8) & 0xFFFF) ^ CRC_TABLE[(crc >> 8) ^ byte]
    return crc


def xor(data):
    sum_ = 0
    for byte in data:
        sum_ ^= byte
    return sum_


def _lines(pattern, stream):
    found, at = [], 0
    while match := pattern.search(stream, at):
        star = match.start(1) - 1
        if xor(stream[match.start() + 1:star]) == int(match.group(1), 16):
            found.append((match.start(), match.end()))
            at = match.end()
        else:
            at = match.start() + 1
    return found


def _imu(stream):
    found, at = [], 0
    while (at := stream.find(IMU_SYNC, at)) >= 0:
        frame = stream[at:at + IMU_BYTES]
        if len(frame) == IMU_BYTES and crc16(frame[2:20]) == int.from_bytes(frame[20:], "big"):
            found.append((at, at + IMU_BYTES))
            at += IMU_BYTES
        else:
            at += 1
    return found


def _oncore(stream):
    found, at = [], 0
    while (at := stream.find(b"@@", at)) >= 0:
        length = ONCORE_BYTES.get(bytes(stream[at + 2:at + 4]), 0)
        frame = stream[at:at + length]
        if length and len(frame) == length and frame[-2:] == b"\r\n" and xor(frame[2:-3]) == frame[-3]:
            found.append((at, at + length))
            at += length
        else:
            at += 1
    return found


FINDERS = {"tcm2": lambda s: _lines(TCM2_WORD, s), "motor-card": lambda s: _lines(MOTOR_LINE, s), "imu-card": _imu,
           "oncore": _oncore}


def intact(protocol, stream):
    """[(begin, end)] of all intact frames that are measurements, in order, none overlapping."""
    return FINDERS[protocol](bytes(stream))


def is_sample(protocol, frame):
    """Whether a frame is one that becomes a logged sample; satellites and the UTC offset do not."""
    return protocol != "oncore" or bytes(frame[2:4]) in (b"Ea", b"Ha")
