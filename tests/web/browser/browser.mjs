// SPDX-License-Identifier: Apache-2.0
// Chromium with a profile of its own, and a page that records what it asks for.
import { mkdtempSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";

const ARGUMENTS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync"];
/** Ends a test that hangs; nothing depends on how fast the machine is. */
export const LIMIT_MS = 120_000;

export function startBrowser(folder, options = {}) {
  return chromium.launchPersistentContext(mkdtempSync(join(folder, "profile-")),
    { executablePath: "/usr/bin/chromium", args: ARGUMENTS, viewport: { width: 1440, height: 1000 }, ...options });
}

export class Page {
  static async open(context, url) {
    const self = new Page();
    self.requests = [];
    self.errors = [];
    self.page = await context.newPage();
    self.page.setDefaultTimeout(LIMIT_MS);
    self.page.on("request", (request) => self.requests.push(request.url()));
    self.page.on("websocket", (socket) => self.requests.push(socket.url()));
    self.page.on("pageerror", (error) => self.errors.push(error.stack));
    await self.page.goto(url);
    return self;
  }
  text(selector) {
    return this.page.locator(selector).innerText();
  }
  /** Waits until the text of an element is so; gives the text. */
  async until(selector, pattern) {
    const locator = this.page.locator(selector);
    let text = "(not there)";
    for (const end = Date.now() + LIMIT_MS; Date.now() < end; await this.page.waitForTimeout(50)) {
      text = (await locator.count()) > 0 ? (await locator.first().textContent()) : "(not there)";
      if (pattern.test(text)) return text;
    }
    throw new Error(`${selector} never showed ${pattern}, but: ${text}`);
  }
  value(name) {
    return `dd[data-name="${name}"] > span`;
  }
}

/** Marks what Tab reaches, until it comes round. */
export async function reachByTab(page) {
  await page.evaluate(() => document.querySelectorAll("[data-reached]").forEach((element) => delete element.dataset.reached));
  for (let i = 0; i < 400; ++i) {
    await page.keyboard.press("Tab");
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
