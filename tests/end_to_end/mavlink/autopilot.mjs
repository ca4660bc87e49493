// SPDX-License-Identifier: Apache-2.0
// usage: autopilot.mjs PORT SECONDS TRUTH [OPTIONS]
// An autopilot with the encoder and parser of node-mavlink: sends MAVLink 2 to a UDP port and answers what is asked.
//
// Its clock is 30 ppm fast; each frame is sent 1 ms + 0 to 20 ms after its time. After half of the time it restarts: its clock
// begins anew. It has added -50 mGauss to the first axis of its compass. Half of the frames of its echo sounder have the sum of
// before their zeros were cut, as BlueOS sends them. It answers TIMESYNC. The file that it writes has the true time of each inertial
// reading, what was sent, and what came.
//
// OPTIONS is a JSON object: `parameters` {name: [value, type]} are all that it has, and may be set; `most` {name: value} clamps
// one; `loss` is the share of requests and of answers that get lost; it is `armed`, or arms when `arms_after` parameters were set
// or `arms_after_reads` read; after `deaf_after` it answers nothing; `px4` sends integers as their bytes. SIGTERM ends it early.
import { createSocket } from "node:dgram";
import { writeFileSync } from "node:fs";
import { setTimeout as delay } from "node:timers/promises";

import mavlink from "node-mavlink";

const { common, minimal, x25crc, MavLinkPacketParser, MavLinkPacketSplitter, MavLinkProtocolV2 } = mavlink;
const MESSAGES = { ...minimal.REGISTRY, ...common.REGISTRY };
const HEAD = MavLinkProtocolV2.PAYLOAD_OFFSET;
const BOOT_US = 1_000_000, TICK_MS = 20, FAST = 1 + 30e-6;

const [port, seconds, truth, options] = process.argv.slice(2);
const { parameters, most = {}, loss = 0, armed = false, arms_after = Infinity, arms_after_reads = Infinity, deaf_after = Infinity, px4 = false } =
  JSON.parse(options ?? "{}");
const INTEGER = 6;
const socket = createSocket("udp4");
const sent = {}, times = [], came = [];
let sequence = 0, restarted_ms = null, bad = 0, seed = 1, set = 0, read = 0, ended = false;

// Numbers from 0 to 1, the same in each run.
function random() {
  seed = (Math.imul(seed, 1_103_515_245) + 12_345) & 0x7fffffff;
  return seed / 0x80000000;
}

function frame(Message, fields, system = 1, component = 1) {
  sent[Message.MSG_ID] = (sent[Message.MSG_ID] ?? 0) + 1;
  return new MavLinkProtocolV2(system, component).serialize(Object.assign(new Message(), fields), sequence++ & 0xff);
}

// The same frame, whose sum was taken with all zeros in it.
function untrimmed(Message, cut) {
  const whole = Buffer.alloc(HEAD + Message.PAYLOAD_LENGTH + 2);
  cut.copy(whole, 0, 0, HEAD + cut[1]);
  whole[1] = Message.PAYLOAD_LENGTH;
  cut.writeUInt16LE(x25crc(whole, 1, 2, Message.MAGIC_NUMBER), HEAD + cut[1]);
  return cut;
}

// An integer of PX4 in place of a float, and back.
function reinterpreted(value, write, read) {
  const bytes = Buffer.alloc(4);
  bytes[write](value);
  return bytes[read]();
}

function answerParameter(paramId) {
  if (!(paramId in parameters) || set >= deaf_after) return;
  ++read;
  const [value, paramType] = parameters[paramId];
  const paramValue = px4 && paramType === INTEGER ? reinterpreted(value, "writeInt32LE", "readFloatLE") : value;
  const bytes = frame(common.ParamValue, { paramId, paramValue, paramCount: 900, paramIndex: 65535, paramType });
  if (random() >= loss) send(bytes);
}

function setParameter({ paramId, paramValue, paramType }) {
  ++set;
  if (!(paramId in parameters) || set > deaf_after) return;
  const value = px4 && paramType === INTEGER ? reinterpreted(paramValue, "writeFloatLE", "readInt32LE") : paramValue;
  parameters[paramId][0] = Math.min(value, most[paramId] ?? Infinity);
  answerParameter(paramId);
}

const send = (bytes) => socket.send(bytes, Number(port), "127.0.0.1");

const splitter = new MavLinkPacketSplitter({}, { onCrcError: () => ++bad });
splitter.pipe(new MavLinkPacketParser()).on("data", (packet) => {
  const { msgid: id, sysid: system, compid: component } = packet.header;
  const said = packet.protocol.data(packet.payload, MESSAGES[id]);
  const what = { id, system, component, again: restarted_ms !== null };
  if (id === common.CommandLong.MSG_ID) {
    what.message = said._param1;
    what.interval_us = said._param2;
    const result = what.message === common.HighresImu.MSG_ID ? 3 : 0; // it does not have that one
    send(frame(common.CommandAck, { command: 511, result, targetSystem: system, targetComponent: component }));
  } else if (parameters !== undefined && (id === common.ParamRequestRead.MSG_ID || id === common.ParamSet.MSG_ID)) {
    if (random() < loss) return;
    what.parameter = said.paramId;
    id === common.ParamSet.MSG_ID ? setParameter(said) : answerParameter(said.paramId);
  } else if (id === common.ParamRequestRead.MSG_ID) {
    what.parameter = said.paramId;
    const paramValue = said.paramId.includes("_DIA_") ? 1 : said.paramId === "COMPASS_OFS_X" ? -50 : 0;
    send(frame(common.ParamValue, { paramId: said.paramId, paramValue, paramCount: 900, paramIndex: 65535, paramType: 9 }));
  } else if (id === common.TimeSync.MSG_ID && said.tc1 === 0n) {
    const answer = frame(common.TimeSync, { tc1: process.hrtime.bigint(), ts1: said.ts1, targetSystem: 0, targetComponent: 0 });
    setTimeout(() => ended || send(answer), 1 + 20 * random()); // as slow as its other frames
  }
  came.push(what);
});
socket.on("message", (bytes) => splitter.write(bytes));

function* framesAt(tick, at_ms) {
  const boot_us = Math.round((at_ms - (restarted_ms !== null && at_ms >= restarted_ms ? restarted_ms : begin_ms)) * FAST * 1e3) + BOOT_US;
  const timeBootMs = Math.floor(boot_us / 1e3);
  times.push((performance.timeOrigin + at_ms) / 1e3);
  if (tick % 50 === 0) {
    const baseMode = armed || set >= arms_after || read >= arms_after_reads ? 209 : 81;
    yield frame(minimal.Heartbeat, { customMode: 0, type: 12, autopilot: px4 ? 12 : 3, baseMode, systemStatus: 4, mavlinkVersion: 3 });
    yield frame(minimal.Heartbeat, { customMode: 0, type: 6, autopilot: 8, baseMode: 0, systemStatus: 0, mavlinkVersion: 3 }, 255, 190);
  }
  yield frame(common.RawImu, { timeUsec: BigInt(boot_us), zacc: -1000, xgyro: tick, xmag: 200 + Math.floor(tick / 5), ymag: -50, zmag: 430 });
  if (tick % 2 === 0) {
    yield frame(common.Attitude, { timeBootMs, roll: 0.1, pitch: -0.2, yaw: 1.5 });
    yield frame(common.ServoOutputRaw, { timeUsec: boot_us >>> 0, servo1Raw: 1500, servo2Raw: 1600 });
  }
  if (tick % 5 === 0) {
    yield frame(common.ScaledPressure2, { timeBootMs, pressAbs: 1500, temperature: 1200 });
    const sounding = frame(common.DistanceSensor,
      { timeBootMs: timeBootMs + 500_000, minDistance: 30, maxDistance: 5000, currentDistance: 250, type: 1, id: 1, orientation: 25, covariance: 255 }, 1, 194);
    yield tick % 10 === 0 ? untrimmed(common.DistanceSensor, sounding) : sounding;
  }
}

async function until(at_ms) {
  // A timer ends up to a millisecond early or late: the last one is waited for awake.
  while (at_ms - performance.now() > 2) await delay(at_ms - performance.now() - 2);
  while (performance.now() < at_ms) await new Promise(setImmediate);
}

process.on("SIGTERM", () => (ended = true));
socket.bind(0, "127.0.0.1");
await new Promise((bound) => socket.once("listening", bound));
const begin_ms = performance.now(), half = Math.floor((seconds * 1e3) / TICK_MS / 2);
let pause_ms = 0;
for (let tick = 0; tick < 2 * half && !ended; ++tick) {
  if (tick === half) {
    pause_ms = 1e3;
    restarted_ms = begin_ms + tick * TICK_MS + pause_ms;
  }
  const at_ms = begin_ms + tick * TICK_MS + pause_ms;
  await until(at_ms);
  const frames = [...framesAt(tick, at_ms)];
  await until(at_ms + 1 + 20 * random());
  frames.forEach(send);
}
if (!ended) await delay(1e3);
ended = true;
socket.close();
writeFileSync(truth, JSON.stringify({ times, sent, came, bad, parameters }));
