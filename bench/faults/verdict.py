# SPDX-License-Identifier: Apache-2.0
"""Holds what was written to the lines against what the log, the decoder and the socket made of it."""
import bisect

import serial_rig as rig
from faults import kinds
from faults.log_bytes import Logs, logs_in
from faults.port_result import Port

NS = rig.NS
PACED_Hz = {"imu": 20, "motor": 10}
PERIOD_TOLERANCE = 0.02  # a hundred times what the cards' crystals may be off by


def recovery(fault, port, watcher):
    """(s from the fault's end to the next sample, s of it from the first whole frame on); None: never."""
    offset = port.reached.begins[fault.life] + fault.offset
    first = bisect.bisect_left(port.frames, (offset, 0))
    k = next((i for i in range(first, len(port.frames)) if port.is_sample[i]), None)
    if k is None:
        return None
    heard = watcher.heard[fault.line.name]
    i = bisect.bisect_left(heard, port.times_ns[k])
    if i == len(heard):
        return None
    return (heard[i] - fault.end_ns) / NS, (heard[i] - port.times_ns[k]) / NS


def told_after_s(fault, watcher):
    """From the cut of a line to the socket's word that its port is away."""
    if fault.cut_ns is None:
        return None
    return next(((t - fault.cut_ns) / NS for t, state in watcher.states[fault.line.name]
                 if t >= fault.cut_ns and state == "away"), None)


def straight_line_errors_us(times_ns, period_s=0.05, least=60):
    """(time, |error|) against the least-squares line through evenly paced times, of which some may be missing."""
    if len(times_ns) < least:
        return []
    origin = times_ns[0]
    y = [(t - origin) / NS for t in times_ns]
    k = [0]
    for a, b in zip(y, y[1:]):
        k.append(k[-1] + round((b - a) / period_s))
    n, sk, sy = len(y), sum(k), sum(y)
    skk, sky = sum(i * i for i in k), sum(i * t for i, t in zip(k, y))
    slope = (n * sky - sk * sy) / (n * skk - sk * sk)
    level = (sy - slope * sk) / n
    return [(time_ns, abs(t - level - slope * i) * 1e6) for time_ns, i, t in zip(times_ns, k, y)]


class Verdict:
    def __init__(self, campaign):
        logs = Logs(logs_in(campaign.daemon.log_folder))
        self.ports = {line.name: Port(line, logs) for line in campaign.lines}
        self.campaign = campaign
        self.events = logs.events

    def kinds(self):
        """{kind: figures}, in the order of the table."""
        rows = {}
        for fault in self.campaign.faults:
            row = rows.setdefault(fault.kind, {"count": 0, "bytes": 0, "logged": 0, "frames": 0, "lost": 0, "no_sample": 0,
                                               "others": 0, "others_lost": 0, "recovery": [], "own": [], "told": [],
                                               "never": 0})
            row["count"] += 1
            written, logged = self.ports[fault.line.name].reached.in_window(fault.begin_ns, fault.back_ns)
            row["bytes"] += written
            row["logged"] += logged
            for name, port in self.ports.items():
                own = name == fault.line.name
                window = port.between(fault.begin_ns, fault.back_ns)
                lost = sum(port.frames[i] not in port.all_decoded for i in window)
                unsampled = sum(port.unsampled[i] for i in window)
                if own:
                    row["frames"] += len(window)
                    row["lost"] += lost
                    row["no_sample"] += unsampled
                else:
                    row["others"] += len(window)
                    row["others_lost"] += lost + unsampled
            back = recovery(fault, self.ports[fault.line.name], self.campaign.watcher)
            if back is None:
                row["never"] += 1
            else:
                row["recovery"].append(back[0])
                row["own"].append(back[1])
            told = told_after_s(fault, self.campaign.watcher)
            if told is not None:
                row["told"].append(told)
        return dict(sorted(rows.items(), key=lambda r: list(kinds.KINDS).index(r[0])))

    def validity(self):
        """Errors of the inertial card's times of validity in us, as stamps(): against the straight line through those
        of each stretch in which the card itself has no fault, for its own clock is even."""
        own = [(f.begin_ns, f.back_ns) for f in self.campaign.faults if f.line.name == "imu"]
        others = [(f.begin_ns, f.back_ns) for f in self.campaign.faults if f.line.name != "imu"]
        samples = self.ports["imu"].reached.received.samples
        edges = [self.campaign.began_ns] + [t for window in own for t in window] + [self.campaign.ended_ns]
        quiet, beside = [], []
        for begin_ns, end_ns in zip(edges[::2], edges[1::2]):
            stretch = [v for arrival, v, _ in samples if begin_ns + NS < arrival < end_ns]
            for validity_ns, error_us in straight_line_errors_us(stretch):
                disturbed = any(a <= validity_ns <= b for a, b in others)
                (beside if disturbed else quiet).append(error_us)
        return sorted(quiet), sorted(beside)

    def stamps(self):
        """Errors of the arrival stamps in us, undisturbed and while another port has its fault."""
        windows = sorted((f.begin_ns, f.back_ns, f.line.name) for f in self.campaign.faults)
        begins = [w[0] for w in windows]
        quiet, beside = [], []
        for name, port in self.ports.items():
            for time_ns, error_us in port.stamp_errors_us():
                if time_ns < self.campaign.began_ns:
                    continue
                k = bisect.bisect_right(begins, time_ns) - 1
                if k < 0 or time_ns > windows[k][1]:
                    quiet.append(error_us)
                elif windows[k][2] != name:
                    beside.append(error_us)
        return sorted(quiet), sorted(beside)

    def problems(self, live=True):
        """What must never be, in words; empty when all is well. Only what is asked of the live samples depends on the
        machine's speed: a host that reads the rest of a frame a quarter of a second late has it given up."""
        found = []
        for name, port in self.ports.items():
            reached = port.reached
            if reached.wrong or reached.missing:
                found.append(f"{name}: the log differs from what was written: {reached.wrong} stretches, "
                             f"{reached.missing} bytes missing")
            if port.lost:
                found.append(f"{name}: {len(port.lost)} intact frames not decoded, the first at {port.lost[0]}")
        for fault in self.campaign.faults:
            if fault.descriptors != self.campaign.first_descriptors:
                found.append(f"{fault.kind} at {fault.line.name}: {fault.descriptors} descriptors, "
                             f"{self.campaign.first_descriptors} before")
        for name, port in self.ports.items():
            if live and any(port.unsampled):
                found.append(f"{name}: {sum(port.unsampled)} intact frames without a sample")
        for name, rate_Hz in PACED_Hz.items():
            period_s = self.ports[name].clock["period_s"]
            if abs(period_s * rate_Hz - 1) > PERIOD_TOLERANCE:
                found.append(f"{name}: the clock's period is {period_s} s at the end")
        for kind, row in self.kinds().items():
            if row["never"]:
                found.append(f"{kind}: {row['never']} times the port never came back")
            if live and row["others_lost"]:
                found.append(f"{kind}: {row['others_lost']} frames of other ports lost")
        if self.campaign.status != 0:
            found.append(f"navcald ended with {self.campaign.status}")
        return found

