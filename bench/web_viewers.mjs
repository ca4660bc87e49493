// SPDX-License-Identifier: Apache-2.0
// See bench/web_viewers. Its navcald is a program of its own here, which sends records of a known time: 20 /nav, 20 /compass, 20 /imu
// and 20 /motor a second with the members of the log, and a compass heading that says when it was sent.
import { spawn } from "node:child_process";
import { createServer, connect } from "node:net";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir, loadavg, cpus } from "node:os";
import { join } from "node:path";
import { randomBytes } from "node:crypto";
import { parseArgs } from "node:util";
import { Browser, Page } from "../tests/web/browser/browser.mjs";
import { delay } from "../tests/web/foxglove/vehicle.mjs";

const { values } = parseArgs({ options: { viewers: { type: "string", default: "50" }, seconds: { type: "string", default: "30" }, build: { type: "string", default: "build/release" } } });
const viewers = Number(values.viewers), seconds = Number(values.seconds);
const folder = mkdtempSync(join(tmpdir(), "navcal-bench-"));
const TICKS = 100; // a second (sysconf(_SC_CLK_TCK) on Linux)

/** navcald's status socket, as far as navcal-web uses it. */
function startSource() {
  let count = 0;
  const sent = new Map();
  const server = createServer((socket) => {
    socket.setNoDelay(true);
    socket.on("error", () => {});
    const timer = setInterval(() => {
      const now = Date.now() / 1000, time = now.toFixed(9);
      const head = `"time":${time},"time_std":0.002,"arrival":${time}`;
      const degrees = (++count % 3600) / 10;
      sent.set(degrees.toFixed(1), performance.now());
      const record = (topic, device, message) => `{"class":"RECORD","topic":"${topic}","device":${device ? `"${device}"` : null},"time":${time},"message":${message}}\n`;
      socket.write(
        record("/nav", "", `{"class":"NAV",${head},"device":"navigation","position":"reckoned","lat":59.3${count % 10},"lon":18.05,"north_std_m":3.1,"east_std_m":2.9,"since_fix_s":31.5,"since_fix_m":35.1,"depth_m":2.05,"heading_rad":1.2,"heading_std_rad":0.02,"pitch_rad":0.01,"roll_rad":0.02,"speed_m_s":1.13,"speed_source":"shaft","velocity_m_s":[0.5,1.0,0.01],"set_north_m_s":0.01,"set_east_m_s":0.02,"altitude_m":7.2,"altitude_std_m":0.1,"predicted_error_m":9.5,"surface_within_s":170,"calibration":null,"crc":"00000000"}`) +
        record("/imu", "imu", `{"class":"IMU",${head},"device":"imu","rate_rad_s":[0.001,-0.002,0.003],"yaw_rate_b_rad_s":0.003,"specific_force_m_s2":[0.1,0.2,-9.81],"depth_m":2.04,"sequence":${count % 256},"leak_forward":false,"leak_aft":false,"low_supply":false,"over_range":false,"calibration":null,"crc":"00000000"}`) +
        record("/motor", "motor", `{"class":"MOTOR",${head},"device":"motor","rpm":780,"rpm_commanded":780,"fins_rad":[0.01,-0.02,0.01],"current_A":1.35,"sequence":${count % 256},"calibration":null,"crc":"00000000"}`) +
        record("/compass", "compass", `{"class":"COMPASS",${head},"device":"compass","heading_rad":${((degrees * Math.PI) / 180).toFixed(9)},"heading_calibrated_rad":null,"heading_is_true":false,"pitch_rad":0.01,"roll_rad":0.02,"field_body_uT":[10.1,12.3,44.1],"temperature_C":12.5,"error":null,"calibration":null,"crc":"00000000"}`));
    }, 50);
    socket.on("close", () => clearInterval(timer));
  });
  return new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve({ port: server.address().port, sent })));
}

/** A viewer of /live that counts what comes; `reads` false: it takes nothing. */
function startViewer(port, onFrame = () => {}, reads = true) {
  const socket = connect(port, "127.0.0.1", () => socket.write(`GET /live HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: ${randomBytes(16).toString("base64")}\r\n\r\n`));
  const viewer = { bytes: 0, end: () => socket.destroy() };
  socket.on("error", () => {});
  if (!reads) return socket.pause(), viewer;
  socket.on("data", (data) => {
    viewer.bytes += data.length;
    onFrame(data);
  });
  return viewer;
}

const cpuSeconds = (pid) => {
  const fields = readFileSync(`/proc/${pid}/stat`, "utf8").split(") ")[1].split(" ");
  return (Number(fields[11]) + Number(fields[12])) / TICKS;
};
const memory_kB = (pid) => Number(readFileSync(`/proc/${pid}/status`, "utf8").match(/VmRSS:\s+(\d+)/)[1]);
const quantile = (list, q) => [...list].sort((a, b) => a - b)[Math.min(list.length - 1, Math.floor(q * list.length))];
const ms = (list) => `median ${quantile(list, 0.5).toFixed(1)} ms, p99 ${quantile(list, 0.99).toFixed(1)} ms, most ${Math.max(...list).toFixed(1)} ms (${list.length})`;

async function cpuOf(pid, count, port) {
  const list = Array.from({ length: count }, () => startViewer(port));
  await delay(2000);
  const [before, begin, bytes] = [cpuSeconds(pid), performance.now(), list.reduce((sum, viewer) => sum + viewer.bytes, 0)];
  await delay(seconds * 1000);
  const span = (performance.now() - begin) / 1000;
  const share = (100 * (cpuSeconds(pid) - before)) / span;
  const rate = (list.reduce((sum, viewer) => sum + viewer.bytes, 0) - bytes) / span / Math.max(1, count) / 1000;
  console.log(`${count} viewers: ${share.toFixed(1)} % of a core, ${rate.toFixed(0)} kB/s each, ${memory_kB(pid)} kB of memory`);
  list.forEach((viewer) => viewer.end());
}

/** Intervals of the frames that a viewer gets, which a stalled one might stretch. */
async function lateness(port) {
  const source_ms = [];
  const viewer = startViewer(port, (data) => {
    const at = data.toString("latin1").match(/"COMPASS","time":([0-9.]+)/);
    if (at) source_ms.push(Date.now() - Number(at[1]) * 1000);
  });
  await delay(seconds * 1000);
  viewer.end();
  return source_ms;
}

async function firstPaint(browser, url) {
  const all = [];
  for (let i = 0; i < 15; ++i) {
    const page = await Page.open(browser, url);
    await delay(700);
    all.push(await page.evaluate(() => performance.getEntriesByName("first-contentful-paint")[0]?.startTime ?? NaN));
    await page.close();
  }
  console.log(`first contentful paint: ${ms(all.filter(Number.isFinite))}`);
}

/** From the record's being sent to the frame in which the page shows it. */
async function recordToPixel(browser, url, sent) {
  const page = await Page.open(browser, url);
  await delay(3000);
  const shown = await page.evaluate((span_ms) => new Promise((resolve) => {
    const list = [], element = document.getElementById("heading-value");
    let last = element.textContent;
    const end = performance.now() + span_ms;
    // The frame after the one that wrote the text: by then it is on the display.
    const look = () => {
      if (element.textContent !== last) list.push([(last = element.textContent), performance.timeOrigin + performance.now()]);
      if (performance.now() < end) requestAnimationFrame(look);
      else resolve(list);
    };
    requestAnimationFrame(look);
  }), seconds * 1000);
  const all = shown.map(([text, at]) => at - performance.timeOrigin - (sent.get(parseFloat(text).toFixed(1)) ?? NaN)).filter(Number.isFinite);
  console.log(`record to pixel: ${ms(all)}`);
  await page.close();
}

const load = () => `load average ${loadavg()[0].toFixed(1)} on ${cpus().length} cores`;
const source = await startSource();
const web = spawn(join(values.build, "web/navcal-web"), ["--port", "0", "--status", `127.0.0.1:${source.port}`], { stdio: ["ignore", "pipe", "inherit"] });
const url = await new Promise((resolve) => web.stdout.once("data", (data) => resolve(String(data).match(/http:\S+/)[0])));
const port = Number(new URL(url).port);
let browser;
try {
  console.log(load());
  browser = new Browser(folder);
  await firstPaint(browser, url);
  await recordToPixel(browser, url, source.sent);
  await browser.end();
  await cpuOf(web.pid, 1, port);
  await cpuOf(web.pid, viewers, port);
  const alone = await lateness(port);
  const stalled = startViewer(port, () => {}, false);
  const beside = await lateness(port);
  stalled.end();
  console.log(`age of a record at a viewer: ${ms(alone)}`);
  console.log(`the same beside a stalled viewer: ${ms(beside)}`);
  console.log(load());
} finally {
  web.kill("SIGTERM");
  await browser?.end();
  rmSync(folder, { recursive: true, force: true });
  process.exit();
}
