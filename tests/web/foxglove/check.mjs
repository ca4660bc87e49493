// SPDX-License-Identifier: Apache-2.0
// Foxglove's own client (@foxglove/ws-protocol) against navcal-web and navcald on emulated instruments. What it gets live must be
// what the log has, byte for byte; Foxglove's own schemas (@foxglove/schemas) judge what is derived. Messages of ROS 2 must be those
// of the bag that is made of the log, and Foxglove's own reader of them must understand them.
//   node check.mjs BUILD_FOLDER FOLDER
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import zstd from "@foxglove/wasm-zstd";
import { McapStreamReader } from "@mcap/core";
import Ajv from "ajv";
import WebSocket from "ws";
import { Vehicle, contents, eventually } from "./vehicle.mjs";
import { Viewer } from "./viewer.mjs";

const require = createRequire(import.meta.url);
const foxgloveSchemas = require("@foxglove/schemas/jsonschema");

const [build, folder] = process.argv.slice(2);
const vehicle = new Vehicle(build, folder);

/** {topic: [{text, bytes, publishTime}]}, {schema name: text} */
function readLogs(paths) {
  const topics = new Map(), schemas = new Map();
  for (const path of paths) {
    const channels = new Map();
    const reader = new McapStreamReader({ decompressHandlers: { zstd: (chunk, size) => zstd.decompress(chunk, Number(size)) } });
    reader.append(contents(path));
    for (let record; (record = reader.nextRecord()); ) {
      if (record.type === "Schema") schemas.set(record.name, Buffer.from(record.data).toString("utf8"));
      if (record.type === "Channel") channels.set(record.id, record);
      if (record.type !== "Message") continue;
      const { topic } = channels.get(record.channelId);
      if (!topics.has(topic)) topics.set(topic, []);
      const bytes = Buffer.from(record.data);
      topics.get(topic).push({ bytes, text: bytes.toString("utf8"), publishTime: record.publishTime });
    }
  }
  return { topics, schemas };
}

/**
 * The live messages of a topic are those of the log, in its order. The first `early` may have gaps between them: the newest of
 * before, and those of the lower rate at which navcal-web listens until navcald knows of the subscription. After them none is missing.
 */
function compare(topic, live, logged, early) {
  let before = -1;
  live.forEach(({ text }, i) => {
    const at = logged.findIndex((message, position) => position > before && message.text === text);
    assert.ok(at > before, `${topic}: message ${i} is in the log, and after the one before it: ${text}`);
    if (i > early) assert.equal(at, before + 1, `${topic}: message ${i} is the next one: ${text}`);
    before = at;
  });
}

/** Nanoseconds of the seconds that stand in the message with nine decimals. */
function timeIn(text) {
  const [, seconds, fraction] = /"time":(\d+)\.(\d{9})/.exec(text);
  return BigInt(seconds + fraction);
}

const STAMP_END = 4 + 8; // of a message in CDR that begins with a header

/** Topics of ROS 2, their types, and what stands in a message. */
const ROS = new Map([
  ["/navcal/imu/data", ["sensor_msgs/msg/Imu", ({ angular_velocity }) => Number.isFinite(angular_velocity.z)]],
  ["/navcal/compass/mag", ["sensor_msgs/msg/MagneticField", ({ magnetic_field: { x, y, z } }) => Math.hypot(x, y, z) < 1e-3]],
  ["/navcal/gps/fix", ["sensor_msgs/msg/NavSatFix", ({ header }) => header.frame_id === "gps"]],
  ["/diagnostics", ["diagnostic_msgs/msg/DiagnosticArray", ({ status }) => status.length > 3]],
]);

async function showsAllTopics() {
  const viewer = new Viewer(vehicle.webPort, ["foxglove.websocket.v1"]);
  await eventually(() => ["/foxglove/tf", ...ROS.keys()].every((topic) => viewer.channels.has(topic)), `channels, of ROS as well: ${[...viewer.channels.keys()]}`);
  assert.equal(viewer.socket.protocol, "foxglove.websocket.v1");
  assert.equal(viewer.info.name, "navcal");
  assert.deepEqual(viewer.info.capabilities, ["time"]);
  assert.match(viewer.info.metadata.version, /^\d+\.\d+/);
  for (const topic of viewer.channels.keys()) viewer.subscribe(topic);
  const wanted = ["/compass", "/imu", "/gps", "/motor", "/nav", "/health", "/foxglove/location", "/foxglove/pose", "/foxglove/tf", ...ROS.keys()];
  await eventually(() => wanted.every((topic) => viewer.of(topic).length >= 5), `messages of all of ${wanted}; there are ` + [...viewer.messages].map(([topic, list]) => `${topic} ${list.length}`));
  viewer.early = new Map([...viewer.messages].map(([topic, list]) => [topic, list.length]));
  return viewer;
}

function judgeDerived(viewer) {
  const ajv = new Ajv({ strict: false });
  for (const [topic, name] of [["/foxglove/location", "LocationFix"], ["/foxglove/pose", "PoseInFrame"], ["/foxglove/tf", "FrameTransform"], ["/foxglove/log", "Log"]]) {
    const theirs = ajv.compile(foxgloveSchemas[name]);
    const channel = viewer.channels.get(topic);
    assert.equal(channel.schemaName, `foxglove.${name}`);
    const ours = ajv.compile(JSON.parse(channel.schema));
    for (const { text, timestamp } of viewer.of(topic)) {
      const message = JSON.parse(text);
      assert.ok(theirs(message), `${topic}: ${JSON.stringify(theirs.errors)}: ${text}`);
      assert.ok(ours(message), `${topic} by its own schema: ${JSON.stringify(ours.errors)}`);
      const { sec, nsec } = message.timestamp;
      assert.equal(BigInt(sec) * 1_000_000_000n + BigInt(nsec), timestamp, `${topic}: timestamp`);
      const named = Object.keys(JSON.parse(channel.schema).properties);
      for (const key of Object.keys(message)) assert.ok(named.includes(key), `${topic}: the schema does not name ${key}`);
    }
  }
}

/** Messages of ROS 2 are those of the bag that navcal makes of the log, in its order, and can be read by their definition. */
async function judgeRos(viewer, live, log) {
  const bag = join(folder, "bag.mcap");
  execFileSync(join(build, "cli/navcal"), ["log", "export", "--ros2", bag, log], { stdio: "pipe" });
  await zstd.isLoaded;
  const { topics } = readLogs([bag]);
  let judged = 0;
  for (const [topic, [type, isRight]] of ROS) {
    const channel = viewer.channels.get(topic), logged = topics.get(topic) ?? [];
    assert.deepEqual([channel.encoding, channel.schemaEncoding, channel.schemaName], ["cdr", "ros2msg", type], topic);
    const reader = new MessageReader(parse(channel.schema, { ros2: true }));
    let at = -1;
    for (const { bytes, timestamp } of live.get(topic)) {
      const message = reader.readMessage(bytes);
      assert.ok(isRight(message), `${topic}: ${JSON.stringify(message)}`);
      const { sec, nsec, nanosec } = message.header.stamp;
      assert.equal(BigInt(sec) * 1_000_000_000n + BigInt(nanosec ?? nsec), timestamp, `${topic}: time of validity`);
      // The log knows UTC better at its end: stamps of what no instrument measured are by that.
      const from = topic === "/diagnostics" ? STAMP_END : 0;
      at = logged.findIndex((other, position) => position > at && other.bytes.subarray(from).equals(bytes.subarray(from)));
      assert.ok(at >= 0, `${topic}: the bag has the message of ${timestamp}, in its order`);
      judged++;
    }
  }
  return judged;
}

/** Every topic and key that the installed layouts name is there. */
function judgeLayouts(viewer) {
  const exists = (topic, key) => {
    const channel = viewer.channels.get(topic);
    assert.ok(channel, `a layout names the topic ${topic}`);
    if (key) assert.ok(key in JSON.parse(channel.schema).properties, `a layout names ${topic}.${key}`);
  };
  const layout = JSON.parse(contents(new URL("../../../share/layouts/foxglove.json", import.meta.url)));
  const paths = [], panels = [];
  const collect = (value, name) => {
    if (typeof value === "string" && /^\/[a-z]/.test(value)) paths.push(value);
    else if (typeof value === "object") for (const [key, member] of Object.entries(value)) collect(member, key);
    if (typeof value === "string" && ["first", "second"].includes(name)) panels.push(value);
  };
  collect(layout.configById);
  collect(layout.layout);
  assert.deepEqual(panels.sort(), Object.keys(layout.configById).sort(), "each panel stands in the layout once");
  for (const path of paths) exists(...path.split("."));
  for (const topic of Object.keys(layout.configById["3D!navcal"].topics)) exists(topic);
  const curves = [...contents(new URL("../../../share/layouts/plotjuggler.xml", import.meta.url)).toString().matchAll(/curve name="(\/\w+)\/(\w+)(\[\d\])?"/g)];
  for (const [, topic, key] of curves) exists(topic, key);
  assert.ok(paths.length > 10 && curves.length > 10);
}

/** A mark in the log is an event: a log message in the viewer. */
async function marksAnEvent(viewer) {
  const net = await import("node:net");
  const control = net.connect(`${folder}/control`);
  control.write('{"command":"event","text":"a mark"}\n');
  await eventually(() => viewer.of("/foxglove/log").some(({ text }) => JSON.parse(text).message.includes("a mark")), "the mark as a log message");
  control.end();
}

async function latches() {
  const viewer = new Viewer(vehicle.webPort, ["foxglove.sdk.v1"]);
  await eventually(() => viewer.channels.has("/event"), "channels");
  assert.equal(viewer.socket.protocol, "foxglove.sdk.v1");
  viewer.subscribe("/event");
  // No event comes by itself: this is the one of before.
  await eventually(() => viewer.of("/event").length > 0, "the newest event");
  const duplicate = viewer.client.subscribe(viewer.channels.get("/event").id);
  await eventually(() => viewer.statuses.some(({ level }) => level === 2), "an error");
  viewer.socket.send(Buffer.from([1, 0, 0, 0, 0]));
  viewer.socket.send("nonsense");
  viewer.client.unsubscribe(duplicate);
  await eventually(() => viewer.statuses.filter(({ level }) => level === 2).length === 4, "errors");
  assert.equal(viewer.socket.readyState, WebSocket.OPEN);
  viewer.client.close();
}

async function survivesTheDaemon(viewer) {
  const session = viewer.info.sessionId;
  const ids = new Map([...viewer.channels].map(([topic, { id }]) => [topic, id]));
  assert.equal(await vehicle.stop(vehicle.daemon), 0, "navcald ends well");
  await eventually(() => viewer.channels.size === 0, "channels go with navcald");
  assert.ok(viewer.statuses.some(({ level }) => level === 1), "and the reason is told");
  await vehicle.startDaemon();
  await eventually(() => viewer.channels.has("/foxglove/tf"), "channels come back");
  assert.deepEqual(new Map([...viewer.channels].map(([topic, { id }]) => [topic, id])), ids);
  assert.equal(viewer.info.sessionId, session);
  viewer.messages.delete("/imu");
  viewer.subscribe("/imu");
  await eventually(() => viewer.of("/imu").length > 3, "messages of the new navcald");
}

try {
  await vehicle.startInstruments();
  await vehicle.startDaemon();
  await vehicle.startWeb();
  const viewer = await showsAllTopics();
  await marksAnEvent(viewer);
  await latches();
  const live = new Map([...viewer.messages].map(([topic, messages]) => [topic, [...messages]]));
  judgeDerived(viewer);
  judgeLayouts(viewer);
  await survivesTheDaemon(viewer);
  const [log] = vehicle.logs().sort();
  const { topics, schemas } = readLogs([log]);
  let compared = 0;
  const isOfRos = (topic) => viewer.channels.get(topic).encoding === "cdr";
  const judged = await judgeRos(viewer, live, log);
  for (const [topic, messages] of live) {
    if (topic.startsWith("/foxglove/") || isOfRos(topic) || messages.length === 0) continue;
    compare(topic, messages, topics.get(topic) ?? [], viewer.early.get(topic));
    for (const { text, timestamp } of messages) if (/"time":\d/.test(text)) assert.equal(timestamp, timeIn(text), `${topic}: time of validity`);
    compared += messages.length;
  }
  for (const { topic, schemaName, schema } of viewer.channels.values()) {
    if (!topic.startsWith("/foxglove/") && !isOfRos(topic)) assert.equal(schema, schemas.get(schemaName), `${topic}: the log's schema`);
  }
  viewer.times.slice(1).forEach((time, i) => assert.ok(time > viewer.times[i], "the time only goes forward"));
  assert.deepEqual(viewer.errors, []);
  assert.equal(await vehicle.stop(vehicle.web), 0, "navcal-web ends well with a viewer connected");
  console.log(`${compared} messages are those of the log, ${judged} those of its bag; ${[...live].map(([topic, list]) => `${topic} ${list.length}`).join(", ")}`);
} catch (error) {
  console.error(error, vehicle.diagnostics());
  process.exitCode = 1;
} finally {
  vehicle.end();
  process.exit();
}
