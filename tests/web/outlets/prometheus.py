# SPDX-License-Identifier: Apache-2.0
"""/metrics of navcal-web as promtool judges it, and as a real Prometheus scrapes it; the alert rules by promtool.

usage: prometheus.py NAVCAL_WEB SOURCE_FOLDER
"""
import os
import shutil
import subprocess
import sys
import urllib.parse

from stand import Stand, free_port, get, get_json, health, need, wait_for

program, source = sys.argv[1:3]
need("prometheus", "promtool")


def promtool(*arguments, text=None, cwd=None):
    done = subprocess.run(["promtool", *arguments], input=text, text=True, capture_output=True, cwd=cwd, check=False)
    said = done.stdout + done.stderr
    assert done.returncode == 0, f"promtool {' '.join(arguments)}: {said}"
    return said


def judged(page):
    """promtool also complains of names and units, with status 3."""
    said = promtool("check", "metrics", text=page)
    assert not said.strip(), said


with Stand() as stand:
    rules = shutil.copy(f"{source}/share/prometheus/navcal.rules.yml", stand.folder)
    shutil.copy(f"{source}/tests/web/outlets/navcal.rules.test.yml", stand.folder)
    print(promtool("check", "rules", rules).strip())
    print(promtool("test", "rules", "navcal.rules.test.yml", cwd=stand.folder).strip())

    navcald = stand.navcald()
    address = stand.web(program, navcald)
    kind, before = get(address + "/metrics")
    assert kind.startswith("text/plain; version=0.0.4"), kind
    judged(before)
    assert "navcald_depth_meters" not in before and "navcald_port" not in before, "a value before anything is known"
    navcald.close()

    navcald = stand.usual_navcald()
    hostile = 'a\\b"c\nd\u00e5'
    odd = health()["ports"][0] | {"device": hostile}
    navcald.every(0.2, "/health", None, lambda: health(part=2, parts=2, ports=[odd]))
    navcald.sources[0][4] = lambda: health(part=1, parts=2)
    stand.end(stand.web_process)
    address = stand.web(program, navcald)
    page = wait_for("all topics", lambda: [text for text in [get(address + "/metrics")[1]] if all(
        name in text for name in ("navcald_depth_meters", "navcald_battery_volts", "navcald_clock_source", "c\\nd"))])[0]
    judged(page)
    assert r'device="a\\b\"c\ndå"' in page, "labels are escaped"

    port = free_port()
    config = os.path.join(stand.folder, "prometheus.yml")
    with open(config, "w", encoding="ascii") as file:
        file.write(f"global: {{scrape_interval: 1s, evaluation_interval: 1s}}\nrule_files: [{rules}]\nscrape_configs:\n  - job_name: navcal\n"
                   f"    static_configs: [{{targets: ['{address.removeprefix('http://')}']}}]\n")
    stand.start("prometheus", f"--config.file={config}", f"--storage.tsdb.path={stand.folder}/data",
                f"--web.listen-address=127.0.0.1:{port}")

    def ask(query):
        found = get_json(f"http://127.0.0.1:{port}/api/v1/query?" + urllib.parse.urlencode({"query": query}))
        return [(one["metric"], float(one["value"][1])) for one in found["data"]["result"]]

    wait_for("the first scrape", lambda: ask("navcald_up"))
    assert [value for _, value in ask('up{job="navcal"}')] == [1], get_json(f"http://127.0.0.1:{port}/api/v1/targets")
    expected = {
        "navcald_up": 1, "navcald_depth_meters": 6.25, "navcald_heading_std_radians": 0.0875,
        'navcald_port_bytes_total{device="compass"}': 123456, 'navcald_port_frames_total{device="compass"}': 1234,
        'navcald_port_bad_checksums_total{device="compass"}': 3, 'navcald_port_gaps_total{device="compass"}': 2,
        'navcald_port_state{device="compass",state="running"}': 1, 'navcald_port_state{device="imu",state="away"}': 1,
        'navcald_port_state{device="imu",state="running"}': 0,
        'navcald_port_latency_seconds_bucket{device="compass",le="6.4e-05"}': 1,
        'navcald_port_latency_seconds_bucket{device="compass",le="0.000128"}': 41,
        'navcald_port_latency_seconds_bucket{device="compass",le="+Inf"}': 1230,
        'navcald_port_latency_seconds_count{device="compass"}': 1230,
        'navcald_port_latency_seconds_sum{device="compass"}': 0.25,
        'navcald_log_state{state="writing"}': 1, "navcald_log_file_bytes": 5000, "navcald_log_lost_records_total": 0,
        "navcald_status_clients": 2, "navcald_status_client_dropped_reports_total": 7,
        'navcald_clock_source{source="gps"}': 1, "navcald_clock_bound_seconds": 0.02,
        'navcald_alarm{alarm="leak_aft",device="imu"}': 1, 'navcald_battery_volts{device="gauge"}': 22.5,
        'navcald_battery_charge_coulombs{device="gauge"}': 7200, "navcal_web_websockets": 0}
    for query, value in expected.items():
        found = ask(query)
        assert len(found) == 1 and abs(found[0][1] - value) < 1e-9 * max(1, abs(value)), f"{query}: {found}, not {value}"
    for absent in ("navcald_altitude_meters", "navcald_water_depth_meters", "navcald_surface_within_seconds"):
        assert not ask(absent), f"{absent} is null and has a value"
    quantile = ask('histogram_quantile(0.5, rate(navcald_port_latency_seconds_bucket{device="compass"}[1m]))')
    assert len(quantile) <= 1
    wait_for("the alert of the leak", lambda: ask('ALERTS{alertname="NavcalLeak",alertstate="firing"}'))

    navcald.close()
    wait_for("navcald is down", lambda: [value for _, value in ask("navcald_up")] == [0])
    judged(get(address + "/metrics")[1])
    wait_for("what is not known is absent", lambda: not ask("navcald_depth_meters"))
print("scraped and judged")
