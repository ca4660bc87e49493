// SPDX-License-Identifier: Apache-2.0
// A log that is dropped on the page becomes the page of its audit.
import assert from "node:assert/strict";
import { mkdirSync, readdirSync, truncateSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { eventually, freePort } from "../foxglove/vehicle.mjs";
import { Page } from "./browser.mjs";

const SAMPLE = fileURLToPath(new URL("../../../share/samples/three-faults.BIN", import.meta.url));

/** Its scripts have run. */
const isReady = (page) => page.when(() => document.readyState === "complete" && document.getElementById("file") !== null);

async function choose(page, file) {
  await isReady(page);
  const { result } = await page.call("Runtime.evaluate", { expression: 'document.getElementById("file")' });
  await page.call("DOM.setFileInputFiles", { objectId: result.objectId, files: [file] });
}

async function drop(page, file) {
  const data = { items: [], files: [file], dragOperationsMask: 1 };
  for (const type of ["dragEnter", "dragOver", "drop"]) await page.call("Input.dispatchDragEvent", { type, x: 300, y: 200, data });
}

export async function auditsLogs(browser, vehicle, folder, step) {
  step("Audit a log: the sample goes in, its page comes back");
  const temporary = join(folder, "audited");
  mkdirSync(temporary);
  const { TMPDIR, PATH } = process.env;
  Object.assign(process.env, { TMPDIR: temporary, PATH: `${join(vehicle.build, "cli")}:${PATH}` });
  const port = await freePort();
  const web = vehicle.start("web/navcal-web", "--port", String(port), "--status", "127.0.0.1:1");
  process.env.PATH = PATH;
  if (TMPDIR == null) delete process.env.TMPDIR;
  else process.env.TMPDIR = TMPDIR;
  await eventually(() => web.output.includes("http://"), "navcal-web");
  const isClean = () => eventually(() => readdirSync(temporary).length === 0, "temporary files removed");

  const page = await Page.open(browser, `http://127.0.0.1:${port}/`);
  await page.click("#audit-link");
  await page.until("h1", /Audit a log/);
  await isReady(page);
  await page.picture(join(folder, "audit-empty.png"));
  await drop(page, SAMPLE);
  await page.until("h1", /Audit of three-faults\.BIN/);
  await page.until("main", /3 found, 0 likely/);
  assert.equal(await page.evaluate(() => document.querySelectorAll("figure svg").length > 0), true);
  assert.match(await page.text("#bar"), /Save this page/);
  await page.picture(join(folder, "audit-page.png"));
  const { data } = await page.call("Page.printToPDF");
  const sheets = Buffer.from(data, "base64").toString("latin1").match(/\/Type\s*\/Page\b(?!s)/g).length;
  assert.ok(sheets <= 2, `it prints on ${sheets} pages`);
  await isClean();

  step("what is wrong with a file is said");
  await page.click("#bar a", "another");
  await page.until("h1", /Audit a log/);
  const bad = join(folder, "bad.BIN"), large = join(folder, "large.BIN"), empty = join(folder, "empty.BIN");
  for (const file of [bad, large, empty]) writeFileSync(file, file === bad ? "this is no log\n" : "");
  truncateSync(large, 2 ** 30 + 1);
  for (const [file, words] of [[bad, /^bad\.BIN: .*bad\.BIN/], [large, /large\.BIN: .*1 GiB/], [empty, /empty\.BIN: the file is empty/]]) {
    await choose(page, file);
    await page.until("#state", words);
    await isClean();
  }

  step("Cancel, and leaving the page, end the audit");
  const long = join(folder, "long.BIN");
  writeFileSync(long, "");
  truncateSync(long, 2 ** 29);
  await choose(page, long);
  await page.until("#state", /Reading long/);
  await eventually(() => readdirSync(temporary).length === 1, "its temporary files");
  await page.click("#cancel");
  await page.until("#state", /^Cancelled/);
  await isClean();
  await choose(page, long);
  await eventually(() => readdirSync(temporary).length === 1, "its temporary files");
  assert.deepEqual(page.errors, []);
  assert.deepEqual(page.requests.filter((url) => !/^(data|blob):/.test(url) && new URL(url).host !== `127.0.0.1:${port}`), []);
  await page.close();
  await isClean();

  step("from elsewhere it is refused");
  const elsewhere = await Page.open(browser, `http://vehicle.local:${port}/`);
  assert.ok(!(await elsewhere.isVisible("#audit-link")));
  await elsewhere.close();
  const refused = await Page.open(browser, `http://vehicle.local:${port}/audit.html`);
  await choose(refused, bad);
  await refused.until("#state", /on the same computer only/);
  await refused.close();
  await vehicle.stop(web);
  assert.deepEqual(readdirSync(temporary), []);
}
