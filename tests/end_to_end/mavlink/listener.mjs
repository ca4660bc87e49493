// SPDX-License-Identifier: Apache-2.0
// usage: listener.mjs PORT [KEY]
// A peer with the parser of node-mavlink: says a heartbeat a second to a UDP port, asks for its clock (TIMESYNC), and prints each
// message that comes as a line of JSON, until SIGTERM. With a key (hex), it signs, and checks signatures.
import { createSocket } from "node:dgram";

import mavlink from "node-mavlink";

const { common, minimal, MavLinkPacketParser, MavLinkPacketSplitter, MavLinkProtocolV2 } = mavlink;
const MESSAGES = { ...minimal.REGISTRY, ...common.REGISTRY };
const [port, hex] = process.argv.slice(2);
const key = hex === undefined ? null : Buffer.from(hex, "hex");
const print = (said) => console.log(JSON.stringify(said, (_, value) =>
  typeof value === "bigint" ? value.toString() : typeof value === "number" && Number.isNaN(value) ? "NaN" : value));

const socket = createSocket("udp4");
const splitter = new MavLinkPacketSplitter({}, { onCrcError: () => print({ bad: true }) });
splitter.pipe(new MavLinkPacketParser()).on("data", ({ header, protocol, payload, signature }) => {
  const { msgid: id, sysid: system, compid: component, seq: sequence, payloadLength: length } = header;
  const trimmed = length <= 1 || payload[length - 1] !== 0;
  print({ id, system, component, sequence, trimmed, signature: signature?.matches(key) ?? null, fields: protocol.data(payload, MESSAGES[id]) });
});
socket.on("message", (bytes) => splitter.write(bytes));

let sequence = 0, signed_ms = 0;
function send(Message, fields) {
  const protocol = new MavLinkProtocolV2(255, 190, key === null ? 0 : MavLinkProtocolV2.IFLAG_SIGNED);
  const frame = protocol.serialize(Object.assign(new Message(), fields), sequence++ & 0xff);
  signed_ms = Math.max(Date.now(), signed_ms + 1); // each later than the one before
  socket.send(key === null ? frame : protocol.sign(frame, 3, key, signed_ms), Number(port), "127.0.0.1");
}
setInterval(() => {
  send(minimal.Heartbeat, { customMode: 0, type: 6, autopilot: 8, baseMode: 0, systemStatus: 4, mavlinkVersion: 3 });
  send(common.TimeSync, { tc1: 0n, ts1: process.hrtime.bigint(), targetSystem: 0, targetComponent: 0 });
}, 1000);
process.on("SIGTERM", () => process.exit(0));
