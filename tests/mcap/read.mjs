// SPDX-License-Identifier: Apache-2.0
// Holds navcal's logs to the format: reads them with @mcap/core.
//   node read.mjs FILE            counts per topic and checks every message's own checksum; JSON on stdout
//   node read.mjs --cuts FILE     cuts the file at every byte of its last 64 KiB and expects every whole message
import { readFileSync } from "node:fs";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";

const HEAD = 9;
const MAGIC = 8;

const crcTable = Array.from({ length: 256 }, (_, i) => {
  let crc = i;
  for (let bit = 0; bit < 8; bit++) crc = crc & 1 ? (crc >>> 1) ^ 0x82f63b78 : crc >>> 1;
  return crc >>> 0;
});

function crc32c(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) crc = crcTable[(crc ^ byte) & 0xff] ^ (crc >>> 8);
  return (crc ^ 0xffffffff) >>> 0;
}

function checksumHolds(channel, data) {
  if (channel.messageEncoding !== "json") {
    const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
    return view.getUint32(data.length - 4, true) === crc32c(data.subarray(0, data.length - 4));
  }
  const text = new TextDecoder("utf-8", { fatal: true }).decode(data);
  return JSON.parse(text).crc === crc32c(data.subarray(0, data.length - 18)).toString(16).padStart(8, "0");
}

function read(bytes, validate) {
  const reader = new McapStreamReader();
  reader.append(bytes);
  const channels = new Map();
  const topics = {};
  let messages = 0;
  let badCrc = 0;
  let statistics;
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Channel") channels.set(record.id, record);
    if (record.type === "Statistics") statistics = record;
    if (record.type === "Schema") JSON.parse(new TextDecoder().decode(record.data));
    if (record.type !== "Message") continue;
    messages++;
    if (!validate) continue;
    const channel = channels.get(record.channelId);
    topics[channel.topic] = (topics[channel.topic] ?? 0) + 1;
    if (!checksumHolds(channel, record.data)) badCrc++;
  }
  return { messages, topics, badCrc, finished: reader.done(), statistics };
}

// Ends of the messages, by walking over the records as the specification says.
function messageEnds(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const ends = [];
  for (let at = MAGIC; at + HEAD <= bytes.length; ) {
    const opcode = bytes[at];
    at += HEAD + Number(view.getBigUint64(at + 1, true));
    if (opcode === 0x05) ends.push(at);
    if (opcode === 0x0f) break;
  }
  return ends;
}

function fail(message) {
  process.stderr.write(`read.mjs: ${message}\n`);
  process.exit(1);
}

async function checkIndex(bytes, found) {
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, length) => bytes.subarray(Number(offset), Number(offset + length)),
  };
  const indexed = await McapIndexedReader.Initialize({ readable });
  const counted = Number(indexed.statistics.messageCount);
  if (counted !== found.messages) fail(`statistics say ${counted} messages, the file has ${found.messages}`);
  for (const [id, count] of indexed.statistics.channelMessageCounts) {
    const topic = indexed.channelsById.get(id).topic;
    if (Number(count) !== (found.topics[topic] ?? 0)) fail(`statistics and messages of ${topic} differ`);
  }
}

function checkCuts(bytes) {
  const ends = messageEnds(bytes);
  const first = Math.max(MAGIC, bytes.length - 65536);
  // What lies before the last message end that no cut touches is parsed once for each cut all the same:
  // the reader is given what a file of that length holds, and nothing else.
  let whole = ends.filter((end) => end <= first).length;
  for (let cut = first; cut <= bytes.length; cut++) {
    while (whole < ends.length && ends[whole] <= cut) whole++;
    const found = read(bytes.subarray(0, cut), false);
    if (found.messages !== whole) fail(`cut at ${cut}: ${found.messages} messages read, ${whole} are whole`);
    if (found.finished !== (cut === bytes.length)) fail(`cut at ${cut}: finished is ${found.finished}`);
  }
  return bytes.length - first + 1;
}

const cuts = process.argv[2] === "--cuts";
const file = process.argv[cuts ? 3 : 2];
if (!file) fail("usage: node read.mjs [--cuts] FILE");
const bytes = new Uint8Array(readFileSync(file));
const found = read(bytes, true);
if (found.badCrc > 0) fail(`${found.badCrc} checksums do not hold`);
if (found.finished) await checkIndex(bytes, found);
const report = { messages: found.messages, topics: found.topics, finished: found.finished };
if (cuts) report.cuts = checkCuts(bytes);
process.stdout.write(JSON.stringify(report) + "\n");
