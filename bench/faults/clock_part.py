# SPDX-License-Identifier: Apache-2.0
"""Steps of the system clock by hours, as navcald sees it (libfaketime in front of it alone; nobody sets this machine's)."""
import glob
import shutil
import sys
import time

import serial_rig as rig
from faults import arguments
from faults.campaign import Campaign
from faults.faults_part import pair
from faults.verdict import Verdict

LIBRARY = "/usr/lib/*/faketime/libfaketime.so.1"
STEP_S = 4  # libfaketime looks once a second, navcald once a second
HOUR_S = 3600


def add(commands):
    parser = arguments.common(commands, "clock", "steps of the system clock by hours")
    parser.add_argument("--steps", type=int, default=60)


def command(a):
    return f"bench/reliability clock --steps {a.steps} --seed {a.seed}"


class ClockCampaign(Campaign):
    def __init__(self, seed):
        library = next(iter(glob.glob(LIBRARY)), None)
        if library is None:
            arguments.skip("there is no libfaketime here (Debian: faketime)")
        self.steps = []
        super().__init__(seed, lambda folder: {
            "LD_PRELOAD": library, "FAKETIME_TIMESTAMP_FILE": f"{folder}/clock", "FAKETIME_DONT_FAKE_MONOTONIC": "1",
            "FAKETIME_CACHE_DURATION": "1", "FAKETIME_DISABLE_SHM": "1"})

    def start(self, environment):
        self.set_clock(0)
        super().start(environment)

    def set_clock(self, offset_s):
        with open(f"{self.folder}/clock", "w") as f:
            f.write(f"{offset_s:+d}\n")

    def run_steps(self, count):
        self.settle()
        self.began_ns = time.monotonic_ns()
        offset_s = 0
        for _ in range(count):
            step_s = self.rng.choice((-1, 1)) * self.rng.randrange(HOUR_S, 12 * HOUR_S)
            offset_s += step_s
            self.set_clock(offset_s)
            self.steps.append(time.monotonic_ns())
            self.pump(STEP_S)
        self.ended_ns = time.monotonic_ns()


def utc_errors_ms(campaign, verdict, offset_s):
    samples = verdict.ports["imu"].reached.received.samples
    return sorted(abs(utc_s - validity_ns / rig.NS - offset_s) * 1000 for arrival, validity_ns, utc_s in samples
                  if arrival >= campaign.began_ns)


def run(a):
    with ClockCampaign(a.seed) as campaign:
        true_offset_s = (time.time_ns() - time.monotonic_ns()) / rig.NS
        campaign.run_steps(2 if a.short else a.steps)
        campaign.finish()
    verdict = Verdict(campaign)
    told = sum(e["name"] == "clock.step" for e in verdict.events)
    utc = utc_errors_ms(campaign, verdict, true_offset_s)
    problems = verdict.problems(live=not a.short)
    if told < len(campaign.steps):
        problems.append(f"{len(campaign.steps)} steps, {told} told")
    # No sample's stamp may follow the clock: an hour is 3.6 million ms.
    if utc[-1] > 60_000:
        problems.append(f"a stamp is {utc[-1] / 1000:.0f} s off")
    backwards = sum(b < a for p in verdict.ports.values()
                    for a, b in zip(p.reached.received.arrivals_ns, p.reached.received.arrivals_ns[1:]))
    if backwards:
        problems.append(f"{backwards} arrivals before the one before")
    if problems or a.keep:
        print(f"kept: {campaign.folder}", file=sys.stderr)
    else:
        shutil.rmtree(campaign.folder, ignore_errors=True)
    frames = {name: [len(p.frames), len(p.lost), sum(p.unsampled)] for name, p in verdict.ports.items()}
    return {"steps": len(campaign.steps), "told": told, "arrivals_backwards": backwards,
            "utc_error_ms": {"median": round(rig.quantile(utc, 0.5), 3), "max": round(utc[-1], 3)},
            "bytes_missing": sum(p.reached.missing for p in verdict.ports.values()),
            "frames_lost_unsampled": frames, "arrival_error_us": pair(verdict.stamps()),
            "imu_validity_error_us": pair(verdict.validity())}, problems
