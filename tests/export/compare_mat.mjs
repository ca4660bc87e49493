// SPDX-License-Identifier: Apache-2.0
// mat-for-js (nobody of navcal wrote it) reads the export; every value must be the one in the CSV files.
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { read } from "mat-for-js";

const [folder, path] = process.argv.slice(2);
const TEXTS = ["device", "fix", "error", "calibration", "position", "source", "severity", "name", "port", "message", "json", "speed_source", "frame", "quantity", "unit"];
const CLOCKS = ["time_s", "arrival_s", "monotonic_s", "offset_s", "at_s"];
let values = 0;

function check(condition, what) {
  if (!condition) {
    console.error(`${path}: ${what}`);
    process.exit(1);
  }
}

// RFC 4180, quotes and all.
function table(text) {
  const rows = [[]];
  for (const [, quoted, bare, end] of text.matchAll(/(?:"((?:[^"]|"")*)"|([^,\n]*))(,|\n)/g)) {
    rows.at(-1).push(quoted === undefined ? bare : quoted.replaceAll('""', '"'));
    if (end === "\n") rows.push([]);
  }
  rows.pop();
  return rows;
}

function nanoseconds(text) {
  const [whole, fraction = ""] = text.split(".");
  return BigInt(whole + fraction.padEnd(9, "0"));
}

// The library gives one value for a column of one, and texts as the codes of their characters.
const column = (data, rows) => (rows === 1 && !Array.isArray(data) ? [data] : data);
const text = (data) => String.fromCharCode(...[data ?? []].flat(2)).trimEnd();

function agrees(expected, value, isText) {
  if (isText) return text(value) === expected.trimEnd();
  if (expected === "") return Number.isNaN(value);
  if (expected === "true" || expected === "false") return value === Number(expected === "true");
  return value === Number(expected);
}

const file = readFileSync(path);
const { data } = read(file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength));
const names = readdirSync(folder).filter((name) => name.endsWith(".csv") && !name.startsWith("raw_"));
check(names.length > 0, "no tables");
check(text(data.configuration) === readFileSync(join(folder, "config.toml"), "utf8").trimEnd(), "configuration");
for (const name of names) {
  const topic = name.slice(0, -".csv".length);
  const [heads, ...rows] = table(readFileSync(join(folder, name), "utf8"));
  const structure = data[topic];
  check(structure !== undefined, `no ${topic}`);
  heads.forEach((head, i) => {
    check(structure[head] !== undefined, `no ${topic}.${head}`);
    const got = column(structure[head], rows.length);
    check(got.length === rows.length, `${topic}.${head}: ${got.length} values, CSV ${rows.length}`);
    rows.forEach((row, at) => {
      if (CLOCKS.includes(head)) {
        const exact = column(structure[head.replace(/_s$/, "_ns")], rows.length)[at];
        const near = row[i] === "" ? Number.isNaN(got[at]) : Math.abs(got[at] - Number(row[i])) <= 5e-7;
        check(near, `${topic}.${head}[${at}]: ${got[at]}, CSV ${row[i]}`);
        check(exact === (row[i] === "" ? -(2n ** 63n) : nanoseconds(row[i])), `${topic}.${head}[${at}]: ${exact} ns`);
      } else {
        check(agrees(row[i], got[at], TEXTS.includes(head)), `${topic}.${head}[${at}]: ${JSON.stringify(got[at])}, CSV ${row[i]}`);
      }
      values++;
    });
  });
}
console.log(`${values} values in ${names.length} structures are those of the CSV files`);
