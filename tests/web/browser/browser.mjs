// SPDX-License-Identifier: Apache-2.0
// Debian's Chromium, driven by the DevTools protocol through its pipe, and a page that records what it asks for.
import { spawn } from "node:child_process";
import { mkdtempSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { delay } from "../foxglove/vehicle.mjs";

const ARGUMENTS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync", "--disable-renderer-backgrounding", "--disable-background-timer-throttling",
  "--disable-backgrounding-occluded-windows", "--hide-scrollbars", "--remote-debugging-pipe", "--host-resolver-rules=MAP vehicle.local 127.0.0.1"];
/** Ends a test that hangs; nothing depends on how fast the machine is. */
export const LIMIT_MS = 120_000;
const KEYS = { Enter: [13, "\r"], Tab: [9], Escape: [27] };

export class Browser {
  constructor(folder) {
    this.calls = new Map();
    this.pages = new Map();
    this.child = spawn("/usr/bin/chromium", [...ARGUMENTS, `--user-data-dir=${mkdtempSync(join(folder, "profile-"))}`], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    this.ended = new Promise((resolve) => this.child.on("exit", resolve));
    this.ended.then(() => this.calls.forEach(({ reject }) => reject(new Error("Chromium has ended"))));
    for (const pipe of this.child.stdio.slice(3)) pipe.on("error", () => {});
    let rest = "";
    this.child.stdio[4].setEncoding("utf8").on("data", (data) => {
      const messages = (rest + data).split("\0");
      rest = messages.pop();
      for (const message of messages) this.#take(JSON.parse(message));
    });
  }
  #take({ id, result, error, method, params, sessionId }) {
    if (id == null) return this.pages.get(sessionId)?.take(method, params);
    const call = this.calls.get(id);
    this.calls.delete(id);
    if (error) call.reject(new Error(`${call.method}: ${error.message}`));
    else call.resolve(result);
  }
  call(method, params = {}, sessionId = undefined) {
    const id = (this.count = (this.count ?? 0) + 1);
    this.child.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
    return new Promise((resolve, reject) => this.calls.set(id, { method, resolve, reject }));
  }
  end() {
    this.child.kill("SIGKILL");
    return this.ended;
  }
}

export class Page {
  /** `before` runs in the page before its own scripts. */
  static async open(browser, url, before = null) {
    const page = new Page();
    Object.assign(page, { browser, requests: [], errors: [], isLoaded: () => {} });
    page.target = await browser.call("Target.createTarget", { url: "about:blank", newWindow: true });
    page.session = (await browser.call("Target.attachToTarget", { ...page.target, flatten: true })).sessionId;
    browser.pages.set(page.session, page);
    for (const domain of ["Page", "Runtime", "Network"]) await page.call(`${domain}.enable`);
    await page.call("Emulation.setFocusEmulationEnabled", { enabled: true });
    await page.setWindow(1440, 1000);
    if (before) await page.call("Page.addScriptToEvaluateOnNewDocument", { source: `(${before})()` });
    await page.#load("Page.navigate", { url });
    return page;
  }
  take(method, params) {
    if (method === "Network.requestWillBeSent") this.requests.push(params.request.url);
    else if (method === "Network.webSocketCreated") this.requests.push(params.url);
    else if (method === "Runtime.exceptionThrown") this.errors.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
    else if (method === "Page.loadEventFired") this.isLoaded();
  }
  call(method, params = {}) {
    return this.browser.call(method, params, this.session);
  }
  async #load(method, params = {}) {
    const loaded = new Promise((resolve) => (this.isLoaded = resolve));
    await this.call(method, params);
    await loaded;
  }
  reload() {
    return this.#load("Page.reload");
  }
  async close() {
    this.browser.pages.delete(this.session);
    await this.browser.call("Target.closeTarget", this.target);
  }

  /** What a function gives in the page. */
  async evaluate(call, ...values) {
    const expression = `(${call})(...${JSON.stringify(values)})`;
    const { result, exceptionDetails: failure } = await this.call("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
    if (failure) throw new Error(failure.exception?.description ?? failure.text);
    return result.value;
  }
  /** The same for those that wait: nothing if the page goes on to another one meanwhile. */
  async #evaluateMeanwhile(call, ...values) {
    try {
      return await this.evaluate(call, ...values);
    } catch (error) {
      if (!/navigated or closed|context was destroyed|find context/.test(error.message)) throw error;
      return null;
    }
  }
  /** Waits until a function gives something in the page. */
  async when(call, ...values) {
    for (const end = Date.now() + LIMIT_MS; Date.now() < end; await delay(50)) {
      const value = await this.#evaluateMeanwhile(call, ...values);
      if (value) return value;
    }
    throw new Error(`waited in vain: ${call} of ${values}`);
  }
  text(selector) {
    return this.evaluate((name) => document.querySelector(name).innerText, selector);
  }
  /** Waits until the text of an element is so; gives the text. */
  async until(selector, pattern) {
    let text = "(not there)";
    for (const end = Date.now() + LIMIT_MS; Date.now() < end; await delay(50)) {
      text = (await this.#evaluateMeanwhile((name) => document.querySelector(name)?.textContent, selector)) ?? "(not there)";
      if (pattern.test(text)) return text;
    }
    throw new Error(`${selector} never showed ${pattern}, but: ${text}`);
  }
  value(name) {
    return `dd[data-name="${name}"] > span`;
  }
  isVisible(selector) {
    return this.evaluate((name) => document.querySelector(name)?.checkVisibility() ?? false, selector);
  }

  /** Clicks with the mouse on the element that contains `text`, once nothing else covers it. */
  async click(selector, text = "") {
    const at = await this.when((name, words) => {
      const element = [...document.querySelectorAll(name)].find((one) => one.textContent.includes(words));
      if (!element || element.disabled) return null;
      element.scrollIntoView({ block: "center", behavior: "instant" });
      const box = element.getBoundingClientRect();
      const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
      return element.contains(document.elementFromPoint(x, y)) ? { x, y } : null;
    }, selector, text);
    for (const type of ["mousePressed", "mouseReleased"]) await this.call("Input.dispatchMouseEvent", { type, ...at, button: "left", clickCount: 1 });
  }
  fill(selector, value) {
    return this.when((name, text) => {
      const element = document.querySelector(name);
      if (!element || element.disabled) return false;
      element.focus();
      element.value = text;
      for (const type of ["input", "change"]) element.dispatchEvent(new Event(type, { bubbles: true }));
      return true;
    }, selector, value);
  }
  async press(key) {
    const [windowsVirtualKeyCode, text] = KEYS[key];
    for (const type of ["keyDown", "keyUp"]) await this.call("Input.dispatchKeyEvent", { type, key, code: key, windowsVirtualKeyCode, text: type === "keyDown" ? text : undefined });
  }

  front() {
    return this.call("Page.bringToFront");
  }
  async setWindow(width, height) {
    await this.call("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
    // Two frames: what is laid out anew has been drawn.
    await this.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  }
  setColors(value) {
    return this.call("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value }] });
  }
  async picture(path) {
    const { data } = await this.call("Page.captureScreenshot", { format: "png" });
    writeFileSync(path, Buffer.from(data, "base64"));
  }
}

/** Marks what Tab reaches, until it comes round. */
export async function reachByTab(page) {
  await page.evaluate(() => document.querySelectorAll("[data-reached]").forEach((element) => delete element.dataset.reached));
  for (let i = 0; i < 400; ++i) {
    await page.press("Tab");
    const isKnown = await page.evaluate(() => {
      const element = document.activeElement;
      // Between the last element and the first is the window itself.
      if (!element || element === document.body) return false;
      const isKnown = element.dataset.reached === "yes";
      element.dataset.reached = "yes";
      return isKnown;
    });
    if (isKnown) return;
  }
  throw new Error("Tab does not come round");
}
