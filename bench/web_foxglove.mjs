#!/usr/bin/env node
// SPDX-License-Identifier: Apache-2.0
// What viewers of Foxglove's protocol get from navcal-web, and what a viewer that does not read costs the others.
//
//     bench/web_foxglove.mjs [--rate 200] [--bytes 1000] [--seconds 20] [--rounds 3] [--viewers 1] [--build build/release]
//
// Records go through a status socket of this program's own. Rounds with and without a stalled viewer alternate; its buffers are
// full before a round begins. Prints the time from the write to the status socket to the viewer's message (this program's own
// share included), the longest silence, and navcal-web's processor time and memory. Needs the npm packages of tests/web/foxglove.
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { cpus, tmpdir } from "node:os";
import { join } from "node:path";
import { parseArgs } from "node:util";
import { FakeNavcald } from "../tests/web/foxglove/fake_navcald.mjs";
import { Vehicle, delay, eventually } from "../tests/web/foxglove/vehicle.mjs";
import { Viewer } from "../tests/web/foxglove/viewer.mjs";

const { values: options } = parseArgs({ options: {
  rate: { type: "string", default: "200" }, bytes: { type: "string", default: "1000" }, seconds: { type: "string", default: "20" },
  rounds: { type: "string", default: "3" }, viewers: { type: "string", default: "1" }, build: { type: "string", default: "build/release" } } });
const [rate, bytes, seconds, rounds, viewers] = ["rate", "bytes", "seconds", "rounds", "viewers"].map((name) => Number(options[name]));

const TICKS_PER_S = 100;
function usage(pid) {
  const fields = readFileSync(`/proc/${pid}/stat`, "utf8").split(") ")[1].split(" ");
  const status = readFileSync(`/proc/${pid}/status`, "utf8");
  return { cpu_s: (Number(fields[11]) + Number(fields[12])) / TICKS_PER_S, resident_KiB: Number(/VmRSS:\s+(\d+)/.exec(status)[1]) };
}

const quantile = (sorted, p) => sorted[Math.min(sorted.length - 1, Math.floor(p * sorted.length))];
const median = (list) => quantile([...list].sort((a, b) => a - b), 0.5);

async function connect(vehicle) {
  const viewer = new Viewer(vehicle.webPort, ["foxglove.sdk.v1"]);
  await eventually(() => viewer.channels.has("/imu"), "channels");
  viewer.subscribe("/imu");
  return viewer;
}

async function round(with_stalled) {
  const folder = mkdtempSync(join(tmpdir(), "navcal-bench-"));
  const vehicle = new Vehicle(options.build, folder);
  const navcald = new FakeNavcald();
  try {
    vehicle.statusPort = await navcald.listen();
    await vehicle.startWeb();
    const reading = [];
    for (let i = 0; i < viewers; i++) reading.push(await connect(vehicle));
    await eventually(() => /"rate_Hz":null/.test(navcald.asked), "the topic is asked for");
    if (with_stalled) {
      const stalled = await connect(vehicle);
      stalled.socket._socket.pause();
    }
    // Fills the buffers of the stalled viewer; without one, the same goes to the others.
    for (let i = 0; i < 100; i++) {
      navcald.send(200, 1000);
      await eventually(() => reading.every((viewer) => viewer.of("/imu").length === navcald.count), "all messages");
    }
    for (const viewer of reading) viewer.messages.set("/imu", []);
    const latencies = [], sent = new Map();
    let last = performance.now(), silence = 0, received = 0;
    reading[0].client.on("message", ({ data }) => {
      const now = performance.now();
      silence = Math.max(silence, now - last);
      last = now;
      latencies.push(now - sent.get(Number(/"n":(\d+)/.exec(new TextDecoder().decode(data))[1])));
    });
    for (const viewer of reading) viewer.client.on("message", () => received++);
    const before = usage(vehicle.web.child.pid), begin = performance.now();
    const total = Math.round(rate * seconds);
    for (let i = 0; i < total; i++) {
      const due = begin + (1000 * i) / rate;
      if (due > performance.now()) await delay(due - performance.now());
      sent.set(navcald.count + 1, performance.now());
      navcald.send(1, bytes);
    }
    await eventually(() => received >= total * viewers, "the last messages", 10_000);
    const after = usage(vehicle.web.child.pid), took_s = (performance.now() - begin) / 1000;
    latencies.sort((a, b) => a - b);
    return { got: received / (total * viewers), p50: quantile(latencies, 0.5), p99: quantile(latencies, 0.99), p999: quantile(latencies, 0.999),
      silence, cpu: (100 * (after.cpu_s - before.cpu_s)) / took_s, resident: after.resident_KiB };
  } finally {
    vehicle.end();
    rmSync(folder, { recursive: true });
  }
}

console.log(`${rate} records/s of ${bytes} bytes for ${seconds} s a round, ${viewers} viewers, ${cpus().length} x ${cpus()[0].model}`);
console.log(`${"".padEnd(16)}${["got", "p50_ms", "p99_ms", "p99.9_ms", "silence_ms", "cpu_%", "resident_KiB"].map((name) => name.padStart(13)).join("")}`);
const p99 = { false: [], true: [] };
for (let i = 0; i < rounds; i++) {
  for (const with_stalled of [false, true]) {
    const r = await round(with_stalled);
    p99[with_stalled].push(r.p99);
    const numbers = [r.got.toFixed(3), r.p50.toFixed(2), r.p99.toFixed(2), r.p999.toFixed(2), r.silence.toFixed(1), r.cpu.toFixed(1), r.resident];
    console.log((with_stalled ? "stalled viewer" : "without").padEnd(16) + numbers.map((number) => `${number}`.padStart(13)).join(""));
  }
}
console.log(`99th percentile with a stalled viewer above that without, median over rounds: ${(median(p99[true]) - median(p99[false])).toFixed(2)} ms`);
process.exit();
