# SPDX-License-Identifier: Apache-2.0
"""Randomised faults at the lines of the vehicle's four instruments."""
import shutil
import sys

import serial_rig as rig
from faults import arguments
from faults.campaign import Campaign
from faults.verdict import Verdict

SHORT_S = 15
WARM = 30  # faults after which memory is compared: by then every path has been gone


def add(commands):
    parser = arguments.common(commands, "faults", "randomised faults at emulated instruments' lines")
    parser.add_argument("--minutes", type=float, default=60)


def command(a):
    return f"bench/reliability faults {'--short' if a.short else f'--minutes {a.minutes:g}'} --seed {a.seed}"


def ms(seconds, share):
    return round(rig.quantile(sorted(seconds), share) * 1000, 3) if seconds else None


def summary(row):
    return {**{k: row[k] for k in ("count", "bytes", "logged", "frames", "lost", "no_sample", "others", "others_lost", "never")},
            **{f"{name}_{label}_ms": ms(row[name], share) for name in ("recovery", "own", "told")
               for label, share in (("median", 0.5), ("p99", 0.99), ("max", 1))}}


def spread(values):
    return {"count": len(values), **{name: round(rig.quantile(values, share), 1)
                                     for name, share in (("median", 0.5), ("p99", 0.99), ("p999", 0.999))}}


def pair(quiet_and_beside):
    return {name: spread(v) for name, v in zip(("undisturbed", "beside_a_fault"), quiet_and_beside) if v}


def figures(campaign, verdict):
    anonymous = [f.anonymous_KiB for f in campaign.faults]
    return {
        "seconds": round((campaign.ended_ns - campaign.began_ns) / rig.NS), "faults": len(campaign.faults),
        "kinds": {kind: summary(row) for kind, row in verdict.kinds().items()},
        "ports": {name: {"written": port.reached.written, "logged": len(port.reached.data),
                         "missing": port.reached.missing, "wrong": port.reached.wrong,
                         "in_flight": port.reached.in_flight, "refused": port.reached.line.refused,
                         "lives": len(port.reached.line.lives), "frames": len(port.frames), "lost": len(port.lost),
                         "decoded": len(port.all_decoded), "live": port.live_frames,
                         "damaged_accepted": port.damaged, "no_sample": sum(port.unsampled), "torn": port.torn}
                  for name, port in verdict.ports.items()},
        "arrival_error_us": pair(verdict.stamps()),
        "imu_validity_error_us": pair(verdict.validity()),
        "descriptors": {"before": campaign.first_descriptors, "after": campaign.faults[-1].descriptors},
        "anonymous_KiB": {"at_first": anonymous[min(WARM, len(anonymous) - 1)], "at_end": anonymous[-1],
                          "most": max(anonymous)},
    }


def tell(campaign):
    if len(campaign.faults) % 20 == 0:
        print(f"{len(campaign.faults)} faults", file=sys.stderr, flush=True)


def run(a):
    with Campaign(a.seed) as campaign:
        campaign.run(SHORT_S if a.short else a.minutes * 60, tell)
        campaign.finish()
    verdict = Verdict(campaign)
    result, problems = figures(campaign, verdict), verdict.problems(live=not a.short)
    if a.keep or problems:
        print(f"kept: {campaign.folder}", file=sys.stderr)
    else:
        shutil.rmtree(campaign.folder, ignore_errors=True)
    return result, problems
