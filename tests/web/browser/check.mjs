// SPDX-License-Identifier: Apache-2.0
// The page in Debian's Chromium, on a real navcald with emulated instruments, and on a recording.
//   node check.mjs BUILD_FOLDER FOLDER
import assert from "node:assert/strict";
import { chmodSync, mkdirSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { Vehicle, delay, eventually, freePort } from "../foxglove/vehicle.mjs";
import { auditsLogs } from "./audit.mjs";
import { Browser, Page, reachByTab } from "./browser.mjs";
import { startProxy } from "./proxy.mjs";

const [build, folder] = process.argv.slice(2);
const TOKEN = "a token of the page's test";
const HEADING_RAD = 1;

/** A vehicle that goes straight on with a known heading, its instruments exact. */
class StraightVehicle extends Vehicle {
  async startInstruments() {
    const path = join(folder, "straight.csv");
    const rows = Array.from({ length: 601 }, (_, i) => [i / 10, (Math.cos(HEADING_RAD) * i) / 10, (Math.sin(HEADING_RAD) * i) / 10, 2, 0, 0, HEADING_RAD, 1, 0, 0, 0, 0, 0, 780, 0, 0, 0].join(","));
    writeFileSync(path, `t,x,y,z,phi,theta,psi,u,v,w,p,q,r,rpm,fin1,fin2,fin3\n${rows.join("\n")}\n`);
    this.instruments = this.start("cli/navcal", "emulate", "--dir", join(folder, "ports"), "--path", path, "--no-noise", "--field", "19,0,44");
    await eventually(() => this.instruments.output.includes("ready"), "emulated instruments");
  }
  async startWeb(token = true) {
    this.webPort ??= await freePort();
    const file = join(folder, "token");
    writeFileSync(file, TOKEN);
    chmodSync(file, 0o600);
    this.web = this.start("web/navcal-web", "--port", String(this.webPort), "--status", `127.0.0.1:${this.statusPort}`, "--control", join(folder, "control"), ...(token ? ["--token-file", file] : []));
    await eventually(() => this.web.output.includes("http://"), "navcal-web");
    return `http://127.0.0.1:${this.webPort}/`;
  }
}

const vehicle = new StraightVehicle(build, folder);
const step = (words) => console.log(`- ${words}`);

async function showsTheVehicle(page) {
  step("the heading shown is the emulated one");
  await page.until("#link-state", /^live$/);
  const heading = parseFloat(await page.until("#heading-value", /\d/));
  assert.ok(Math.abs(heading - (HEADING_RAD * 180) / Math.PI) < 1, `heading ${heading}`);
  const depth = parseFloat(await page.until(page.value("depth"), /\d/));
  assert.ok(Math.abs(depth - 2) < 0.2, `depth ${depth}`);
  step("each panel has content, and what is absent says why");
  assert.match(await page.until(page.value("shaft"), /\d/), /780\u202frpm/);
  assert.equal(await page.text(page.value("charge")), "absent");
  assert.match(await page.text('dd[data-name="charge"]'), /no gauge/);
  for (const port of ["compass", "imu", "gps", "motor"]) await page.until(`tr[data-port="${port}"]`, /running.*\d\u202f\/s/s);
  for (const calibrator of ["gyro", "compass", "magnetometer"]) await page.until(`tr[data-calibrator="${calibrator}"]`, /refused|shadow|in force/);
  await page.when(() => document.querySelectorAll("#plot-area canvas").length === 4);
  assert.match(await page.evaluate(() => document.getElementById("rose").getAttribute("aria-label")), /Heading 57 degrees/);
}

async function looksRight(page, name) {
  step("light, dark and chosen colours");
  const turns = (color) => page.when((wanted) => getComputedStyle(document.body).backgroundColor === wanted, color);
  const DARK = "rgb(14, 19, 24)", LIGHT = "rgb(238, 241, 244)";
  for (const [scheme, color] of [["light", LIGHT], ["dark", DARK]]) {
    await page.setColors(scheme);
    await turns(color);
    await page.picture(join(folder, `${name}-${scheme}.png`));
  }
  await page.click("#theme");
  await turns(LIGHT);
  await page.click("#theme");
  await page.click("#theme");
  await turns(DARK);
}

async function fitsEveryWindow(page, name) {
  for (const width of [320, 390, 768, 1024, 1440, 1920]) {
    step(`at ${width} px: no horizontal scrolling, STOP in view, one heading`);
    await page.setWindow(width, 844);
    for (const end of [false, true]) {
      // The page grows while it is looked at: it is scrolled and measured in one step.
      const seen = await page.evaluate((isEnd) => {
        window.scrollTo({ top: isEnd ? document.documentElement.scrollHeight : 0, behavior: "instant" });
        const box = document.getElementById("stop").getBoundingClientRect();
        const top = document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2);
        const last = document.getElementById("system").getBoundingClientRect().bottom;
        return { whole: document.documentElement.scrollWidth, box: box.toJSON(), isOnTop: top?.id === "stop", last, bar: document.getElementById("stop-bar").getBoundingClientRect().top };
      }, end);
      assert.ok(seen.whole <= width, `${seen.whole} px in a window of ${width}`);
      assert.ok(seen.isOnTop && seen.box.left >= 0 && seen.box.top >= 0 && seen.box.right <= width && seen.box.bottom <= 844, `STOP at ${JSON.stringify(seen)}`);
      assert.ok(!end || seen.last <= seen.bar, `STOP covers the end of the page: ${JSON.stringify(seen)}`);
      await page.picture(join(folder, `${name}-${width}-${end ? "end" : "top"}.png`));
    }
    // The kind, and the estimator's error, of the one number that is called a heading.
    const headings = await page.evaluate(() => [...document.querySelectorAll("#heading .big, #heading dd")].map((element) => element.innerText).filter((text) => /\d\u00b0(?!\/)/.test(text)));
    assert.equal(headings.length, 1, headings.join("; "));
    assert.match(headings[0], /^\d+\.\d+ \u00b1 \d+(\.\d+)?\u00b0 (magnetic|true)$/);
    const shown = Number(headings[0].match(/\u00b1 ([\d.]+)/)[1]);
    const { records } = await (await fetch(`http://127.0.0.1:${vehicle.webPort}/live.json`)).json();
    const std = (records.find(([topic]) => topic === "/nav")[2].heading_std_rad * 180) / Math.PI;
    assert.ok(Math.abs(shown - std) < 0.1 + 0.1 * std, `the error shown is ${shown}, the estimator's ${std}`);
  }
  await page.setWindow(1440, 1000);
}

async function remembersWhatWasBefore(page) {
  step("after a reload the plots have what was before it");
  const DAY_S = 86_400;
  const seconds = (text) => text.match(/(\d\d):(\d\d):(\d\d)/).slice(1).reduce((sum, part) => 60 * sum + Number(part), 0);
  const since = (text, before) => (seconds(text) - seconds(before) + DAY_S) % DAY_S;
  const shown = await page.until("#now", /:\d\d UTC/);
  // Longer than the log waits before it writes.
  for (let now = shown; since(now, shown) < 5; await delay(100)) now = await page.text("#now");
  await page.reload();
  const opened = await page.until("#now", /:\d\d UTC/);
  await page.when(() => document.querySelectorAll("#plot-area .u-over").length === 4);
  // The pointer at the left edge of a plot shows the oldest values of all.
  const oldest = async () => {
    const at = await page.evaluate(() => {
      const plot = document.querySelector("#plot-area .u-over");
      plot.scrollIntoView({ block: "center", behavior: "instant" });
      const box = plot.getBoundingClientRect();
      return { x: box.x + 3, y: box.y + 30 };
    });
    await page.call("Input.dispatchMouseEvent", { type: "mouseMoved", ...at });
    return page.evaluate(() => [...document.querySelectorAll("#plot-area .legend")].map((legend) => legend.textContent));
  };
  let texts;
  const isBefore = (text) => /at \d\d:/.test(text) && since(opened, text) >= since(opened, shown) && /-?\d+\.\d\d/.test(text);
  for (const end = Date.now() + 30_000; Date.now() < end && !(texts?.every(isBefore)); await delay(100)) texts = await oldest();
  assert.ok(texts.every(isBefore), `the page was opened at ${opened}, the oldest values of the plots: ${texts.join("; ")}`);
  assert.equal(await page.text("#plot-history"), "");
}

async function keyboardReachesAll(page) {
  step("the keyboard reaches everything that can be done");
  await reachByTab(page);
  const missed = await page.evaluate(() => [...document.querySelectorAll("button, input, select, [tabindex='0'], a[href]")].filter((element) => element.checkVisibility() && !element.disabled && !element.dataset.reached).map((element) => element.outerHTML.slice(0, 120)));
  assert.deepEqual(missed, []);
  const unnamed = await page.evaluate(() => [...document.querySelectorAll("button, input, select, canvas[id], svg[role]")].filter((element) => element.checkVisibility() && !(element.labels?.length || element.getAttribute("aria-label") || element.getAttribute("aria-labelledby") || element.textContent.trim())).map((element) => element.outerHTML.slice(0, 120)));
  assert.deepEqual(unnamed, [], "controls without a name");
}

async function changesNeedTheToken(page) {
  step("without the token nothing can be changed");
  const button = (calibrator) => `tr[data-calibrator="${calibrator}"] button`;
  const isOff = (selector, text) => page.evaluate((name, words) => [...document.querySelectorAll(name)].find((one) => one.textContent.includes(words)).disabled, selector, text);
  assert.ok(await isOff(button("magnetometer"), "Accept"));
  assert.ok(await isOff("#stop", "STOP"));
  await page.fill("#token", "a wrong token of enough letters");
  await page.press("Enter");
  await page.until("#control-state", /wrong token/);
  assert.ok(await isOff(button("magnetometer"), "Accept"));
  step("with it: marks, calibrations");
  await page.fill("#token", TOKEN);
  await page.press("Enter");
  await page.when(() => !document.getElementById("stop").disabled);
  await page.fill("#mark-text", "the page's mark \u00fc <b>");
  await page.press("Enter");
  await page.until("#event-list", /the page's mark \u00fc <b>/);
  const magnetometer = (words) => page.click(button("magnetometer"), words);
  await magnetometer("Start anew");
  await page.when(() => document.getElementById("ask").open);
  // The next question comes before the page is told that the dialog of this one was closed.
  await page.evaluate((name) => {
    document.querySelector('#ask button[value="no"]').click();
    [...document.querySelectorAll(name)].find((one) => one.textContent.includes("Start anew")).click();
  }, button("magnetometer"));
  await page.click('#ask button[value="yes"]');
  await page.until("#calibration-answer", /magnetometer: done/);
  await page.until("#event-list", /calibration/);
  await magnetometer("Accept");
  await page.click('#ask button[value="no"]');
  await page.until("#calibration-answer", /magnetometer: (?!done)/);
  await magnetometer("Roll back");
  await page.until("#calibration-answer", /magnetometer: (?!done)/);
}

async function drives(page) {
  step("remote control: orders while the lease is held, and a stop");
  const take = async () => {
    await page.front();
    await page.click("#take");
    await page.until("#control-state", /You are in charge.*In charge: navcal-web/);
  };
  await take();
  await page.fill("#order-shaft", "300");
  await page.until("#control-state", /sent: shaft 300/);
  await page.until(`dd[data-name="shaft"]`, /ordered 300/);
  await page.press("Escape");
  await page.until("#control-state", /^Nobody is in charge.*shaft 0.*safe state/);
  await take();
  await page.click("#stop");
  await page.until("#control-state", /^Nobody is in charge/);
  await take();
  await page.evaluate(() => void window.dispatchEvent(new Event("blur")));
  await page.until("#control-state", /^Nobody is in charge/);
  await take();
  step("closing the page ends the lease");
  await page.reload();
  await page.until("#control-state", /Nobody is in charge/);
  // The token is kept for the tab.
  await page.when(() => !document.getElementById("stop").disabled);
}

async function stopsWhoeverIsInCharge(browser, url, page) {
  step("STOP of a second page, while the first is in charge");
  const second = await Page.open(browser, url);
  await second.until("#link-state", /^live$/);
  await second.fill("#token", TOKEN);
  await second.press("Enter");
  await second.when(() => !document.getElementById("stop").disabled);
  await page.front();
  await page.click("#take");
  await page.until("#control-state", /You are in charge/);
  await page.fill("#order-shaft", "300");
  await second.until("#control-state", /^In charge: navcal-web.*sent: shaft 300/);
  await second.evaluate(() => document.getElementById("stop").click());
  await second.until("#control-answer", /^Stopped/);
  await second.until("#control-state", /^Nobody is in charge.*shaft 0.*safe state/);
  await page.until("#control-answer", /no longer in charge: stopped by navcal-web/);
  await second.close();
}

async function comesBack(page) {
  step("after a restart of navcald");
  await vehicle.stop(vehicle.daemon);
  await page.until("#link-lost", /NO CONNECTION TO NAVCALD/);
  assert.ok(await page.isVisible("#link-lost"));
  await vehicle.startDaemon();
  await page.until("#link-state", /^live$/);
  await page.when(() => document.getElementById("link-lost").hidden);
  await page.until("#heading-value", /^57|^58|^56/);
  step("after a restart of navcal-web");
  await vehicle.stop(vehicle.web);
  await page.until("#link-lost", /LINK LOST/);
  assert.ok(await page.evaluate(() => document.body.classList.contains("lost")));
  await vehicle.startWeb();
  await page.until("#link-state", /^live$/);
  await page.when(() => document.getElementById("link-lost").hidden);
  // The new server has values only once the instruments have sent some; until the next frame is drawn, the old ones stand.
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  await page.until("#heading-value", /^5[678]/);
  step("stale values are marked");
  vehicle.stop(vehicle.instruments);
  await page.until("#heading h2 .age", /stale/);
  await vehicle.startInstruments();
  await page.until("#heading h2 .age", /^$/);
}

async function worksBehindProxies(browser, url) {
  step("without WebSockets it polls, and says so");
  const polling = await Page.open(browser, url, () => {
    window.WebSocket = class extends EventTarget {
      constructor() { super(); setTimeout(() => this.onclose?.({ reason: "" }), 1); }
      close() {}
    };
  });
  await polling.until("#link-state", /polling/);
  await polling.until("#heading-value", /^5[678]/);
  await polling.close();
  step("in a frame, under a path");
  const proxy = await startProxy(vehicle.webPort);
  const outer = await Page.open(browser, `http://127.0.0.1:${proxy.port}/`);
  const inFrame = (id, pattern) => outer.when((name, wanted) => new RegExp(wanted).test(document.querySelector("iframe").contentDocument.getElementById(name)?.textContent), id, pattern);
  await inFrame("link-state", "^live$");
  await inFrame("heading-value", "^5[678]");
  onlyAsksFor(outer, `127.0.0.1:${proxy.port}`);
  await outer.close();
  proxy.end();
}

function onlyAsksFor(page, host) {
  const foreign = page.requests.filter((url) => !/^(data|blob):/.test(url) && new URL(url).host !== host);
  assert.deepEqual(foreign, []);
  assert.ok(page.requests.some((url) => url.startsWith("ws:")), "no WebSocket was seen");
  assert.deepEqual(page.errors, []);
}

async function isReadOnlyWithoutAToken(browser) {
  step("a server without a token says that it may only be looked at");
  await vehicle.stop(vehicle.web);
  const url = await vehicle.startWeb(false);
  const page = await Page.open(browser, url);
  await page.until("#control-state", /may only be looked at/);
  assert.ok(!(await page.isVisible("#stop")));
  await page.close();
}

async function playsRecordings(browser) {
  step("navcal view plays a capture, and leaves nothing behind");
  const capture = join(folder, "dive.cap");
  const temporary = join(folder, "temporary");
  mkdirSync(temporary);
  assert.equal(await vehicle.start("cli/navcal", "simulate", "--mission", "calibration_swing", "-o", capture).ended, 0);
  process.env.TMPDIR = temporary;
  const view = vehicle.start("cli/navcal", "view", capture, "--no-open", "--speed", "5");
  const url = (await eventually(() => view.output.match(/http:\S+/), "navcal view"))[0];
  assert.equal(readdirSync(temporary).length, 1);
  const page = await Page.open(browser, url);
  await page.until("#link-state", /^recording$/);
  await page.until("#mode", /dive\.cap/);
  await page.until("#heading-value", /\d/);
  const position = () => page.evaluate(() => Number(document.getElementById("seek").value));
  const before = await position();
  await page.until("#play", /Pause/);
  while ((await position()) <= before + 1) await delay(50);
  await page.click("#play");
  await page.until("#play", /Play/);
  const stopped = await position();
  await delay(300);
  assert.equal(await position(), stopped);
  await page.fill("#seek", "5");
  while (Math.abs((await position()) - 5) > 0.2) await delay(50);
  await page.until("#play-time", /^0:00:05/);
  await page.fill("#speed", "100");
  await page.click("#play");
  const end = await page.evaluate(() => document.getElementById("seek").max);
  while ((await position()) < Number(end) - 0.2) await delay(50);
  await page.until("#play", /Play/);
  await page.when(() => document.querySelectorAll("#plot-area canvas").length === 4);
  await page.until("#event-list", /mark/);
  await page.picture(join(folder, "recording.png"));
  assert.match(await page.text("#control-state"), /recording cannot be changed/);
  onlyAsksFor(page, new URL(url).host);
  await page.close();
  view.child.kill("SIGINT");
  assert.equal(await view.ended, 0, view.output);
  assert.deepEqual(readdirSync(temporary), []);
  step("a wrong file is named, with status 3");
  const wrong = join(folder, "wrong.mcap");
  writeFileSync(wrong, "this is no recording\n");
  const refused = vehicle.start("cli/navcal", "view", wrong, "--no-open");
  assert.equal(await refused.ended, 3, refused.output);
  assert.match(refused.output, /wrong\.mcap/);
  assert.deepEqual(readdirSync(temporary), []);
}

let browser;
try {
  await vehicle.startInstruments();
  await vehicle.startDaemon();
  const url = await vehicle.startWeb();
  browser = new Browser(folder);
  const page = await Page.open(browser, url);
  await showsTheVehicle(page);
  await looksRight(page, "live");
  await fitsEveryWindow(page, "live");
  await keyboardReachesAll(page);
  await changesNeedTheToken(page);
  await keyboardReachesAll(page);
  await drives(page);
  await stopsWhoeverIsInCharge(browser, url, page);
  await remembersWhatWasBefore(page);
  await comesBack(page);
  onlyAsksFor(page, new URL(url).host);
  await worksBehindProxies(browser, url);
  await page.close();
  await isReadOnlyWithoutAToken(browser);
  await playsRecordings(browser);
  await auditsLogs(browser, vehicle, folder, step);
  console.log("the page does what it should");
} catch (error) {
  console.error(vehicle.diagnostics());
  console.error(error);
  process.exitCode = 1;
} finally {
  await browser?.end();
  vehicle.end();
}
