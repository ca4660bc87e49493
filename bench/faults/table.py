# SPDX-License-Identifier: Apache-2.0
"""The tables of docs/reliability.md, from the results of the parts."""
import os

import serial_rig as rig
from faults import parts

PAGE = os.path.join(rig.ROOT, "docs", "reliability.md")
BEGIN, END = "<!-- figures: begin -->", "<!-- figures: end -->"


def rows(head, lines):
    table = [head, ["---"] * len(head)] + lines
    return "\n".join("| " + " | ".join(str(cell) for cell in row) + " |" for row in table)


def time_ms(row, name):
    if row[f"{name}_median_ms"] is None:
        return "-"
    return " / ".join(f"{row[f'{name}_{q}_ms']:.3g}" if row[f"{name}_{q}_ms"] < 100 else f"{row[f'{name}_{q}_ms']:.0f}"
                      for q in ("median", "p99", "max"))


def pair(figures, what):
    return "; ".join(f"{name.replace('_', ' ')} {v['median']} / {v['p99']} / {v['p999']} us ({v['count']} {what})"
                     for name, v in figures.items())


def faults(r):
    lines = [[kind, k["count"], f"{k['logged']} of {k['bytes']}", k["frames"], k["lost"], k["others_lost"],
              time_ms(k, "recovery"), time_ms(k, "own"), time_ms(k, "told")] for kind, k in r["kinds"].items()]
    ports = [[name, p["written"], p["missing"], p["in_flight"], p["frames"], p["lost"], p["no_sample"],
              p["torn"], p["damaged_accepted"], p["lives"]] for name, p in r["ports"].items()]
    return "\n\n".join([
        f"{r['faults']} faults in {r['seconds']} s.",
        rows(["fault", "count", "bytes in the log", "intact frames", "not decoded", "lost at other ports",
              "recovered after, ms", "of that by navcald, ms", "reported after, ms"], lines),
        rows(["port", "bytes written", "missing in the log", "in flight when cut", "intact frames", "not decoded",
              "without a sample", "torn by a pause", "damaged, with a valid checksum", "times opened"], ports),
        f"Arrival stamps, median / 99th / 99.9th percentile of their error: {pair(r['arrival_error_us'], 'reads')}.",
        f"Times of validity of the inertial card, likewise: {pair(r['imu_validity_error_us'], 'samples')}.",
        f"Descriptors {r['descriptors']['before']} before and {r['descriptors']['after']} after; private memory "
        f"{r['anonymous_KiB']['at_first']} KiB after 30 faults, {r['anonymous_KiB']['at_end']} KiB at the end."])


def clock(r):
    beside = r["imu_validity_error_us"]["undisturbed"]
    return (f"{r['steps']} steps of 1 to 12 hours, {r['told']} reported; {r['bytes_missing']} bytes and "
            f"{sum(lost + none for _, lost, none in r['frames_lost_unsampled'].values())} frames lost; "
            f"{r['arrivals_backwards']} arrivals earlier than their predecessor; UTC of a sample off by "
            f"{r['utc_error_ms']['median']} ms in the median, {r['utc_error_ms']['max']} ms at most; times of validity of the "
            f"inertial card {beside['median']} / {beside['p99']} us (median, 99th percentile).")


def kill(r):
    w = r["loss_window_s"]
    return (f"{r['kills']} kills. Loss window (age of the oldest byte that the log lacks) {w['median']} / {w['p99']} / {w['max']} s "
            f"(median, 99th percentile, greatest), {r['over_the_interval']} times above the sync interval of "
            f"{r['sync_interval_s']} s; {r['torn_tails']} torn tails; {r['logs_finished']} logs finished by the next start, "
            f"{r['unreadable']} unreadable; start to first answer {r['start_s']['median']} s, at most {r['start_s']['max']} s.")


def storage(r):
    return rows(["disk", "bytes written", "missing in the log", "log state of navcald", "stopped after, s", "fsck"],
                [[name, k["written"], k["missing"], "; ".join(k["said"]), k["stop_s"],
                  "clean" if k["fsck"] == 0 else k["fsck"]] for name, k in r["kinds"].items()])


def network(r):
    lines = [[name, *values.values()] for name, values in r["latency"].items()]
    return "\n\n".join([
        rows(["latency of a record at a client that reads, us", "median", "99th", "99.9th percentile", "most"], lines),
        f"{r['clients_held']} clients at once, {r['acts']} hostile acts; {r['answered']} of {r['records']} records answered; "
        f"descriptors {r['descriptors'][0]} before and {r['descriptors'][1]} after, memory {r['growth_KiB']:+d} KiB; a command "
        f"on the control socket by the user nobody: {r['command_by_nobody']}."])


def seconds(figures):
    return "-" if figures is None else f"{figures['median']} / {figures['max']}"


def gpsd(r):
    def line(label, value):
        return [label] + [value(r[kind]) for kind in ("navcald", "gpsd")]
    return rows(["fault", "navcald", "gpsd"], [
        line("hang-ups, and those without recovery (20 s)", lambda k: f"{k['hang_up']['cycles']}, {k['hang_up']['never_back']}"),
        line("recovered after, s (median / greatest)", lambda k: seconds(k["hang_up"]["return_s"])),
        line("reported to the client after, s", lambda k: seconds(k["hang_up"]["told_s"])),
        line("0 to 63 random bytes before each record: records kept", lambda k: f"{k['garbage']['kept']} of {k['garbage']['sent']} "
             f"({100 * k['garbage']['kept'] / k['garbage']['sent']:.1f} %)"),
        line("their latency, us (median / 99th percentile)", lambda k: f"{k['garbage']['p50_us']:.0f} / {k['garbage']['p99_us']:.0f}"),
        line("a client that never reads: records of another client answered", lambda k: f"{k['stalled_client']['answered']} of "
             f"{k['stalled_client']['sent']}"),
        line("longest silence of that other client, s", lambda k: k["stalled_client"]["longest_silence_s"]),
    ])


def memory(r):
    v, n, alone, d = r["valgrind"], r["allocations"], r["frames_alone"], r["day"]
    found = "nothing found" if v["status"] == 0 else f"status {v['status']}: " + " ".join(v["said"][:3])
    m = d["anonymous_KiB"]
    return "\n".join([
        f"- valgrind's memcheck, leaks included, {v['frames']} frames with a hang-up of each port: {found}.",
        f"- {alone['allocations']} allocations for {alone['samples']} samples in {alone['seconds']:g} s, log, one client, calibration and "
        f"navigation on: {alone['each']} each, without the periodic reports (HEALTH, CALIB); with them "
        f"{n['allocations']} for {n['samples']}: {n['each']}.",
        f"- {d['hours']:g} hours of simulated mission ({d['recording_MB']} MB, {d['samples']} samples) replayed at "
        f"{d['times_real_time']} times real time: private memory {m['after_a_tenth']} KiB after a tenth, {m['at_half']} KiB at half, "
        f"{m['at_end']} KiB at the end."])


def power_cut(r):
    w, service = r["loss_window_s"], r["service"]
    return "\n".join([
        f"- {r['cuts']} cuts. Loss window {w['median']} s in the median, {w['max']} s at most, sync interval {r['sync_interval_s']} s; "
        f"{r['torn_tails']} torn tails, {r['unreadable']} of {r['logs']} logs unreadable after the next boot, {r['fsck_bad']} file "
        f"systems not clean after their journal; boot {r['boot_s']} s.",
        f"- The service: {service['booted']}; status \"{service['status']}\"; hung daemon: {service['watchdog']}, then "
        f"{service['again']}; calls forbidden by the filter: {service['seccomp']}."])


SECTIONS = {"faults": ("Faults at the lines", faults), "clock": ("Steps of the system clock", clock),
            "kill": ("SIGKILL while logging", kill), "storage": ("Disks", storage), "network": ("The sockets under attack", network),
            "gpsd": ("The same faults, navcald and gpsd", gpsd),
            "memory": ("Memory and time", memory), "power_cut": ("Power cuts under systemd", power_cut)}


def text():
    parts_of_page = []
    for name, r in parts.results(SECTIONS).items():
        title, write_section = SECTIONS[name]
        made = f"`{r['command']}`, {r['date']}, {r['machine']['cpus']} cores, load {r['machine']['load']} from other programs."
        found = "".join(f"\n\n**{p}**" for p in r["problems"])
        parts_of_page.append(f"### {title}\n\n{made}\n\n{write_section(r)}{found}")
    return "\n\n".join(parts_of_page)


def write():
    with open(PAGE) as f:
        page = f.read()
    page = f"{page[:page.index(BEGIN)]}{BEGIN}\n\n{text()}\n\n{page[page.index(END):]}"
    with open(PAGE, "w") as f:
        f.write(page)
