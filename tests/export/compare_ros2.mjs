// SPDX-License-Identifier: Apache-2.0
// The MCAP project's reader and Foxglove's reader of ROS 2 messages (nobody of navcal wrote them) read the bag; every message must have
// the values of its row in the CSV files, in the axes of REP 103.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { McapIndexedReader } from "@mcap/core";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import zstd from "@foxglove/wasm-zstd";

const [folder, path] = process.argv.slice(2);

/** Rows of a CSV file as objects of texts, of one device each. */
function rows(topic) {
  const file = join(folder, `${topic}.csv`);
  if (!existsSync(file)) return [];
  const [heads, ...lines] = readFileSync(file, "utf8").trimEnd().split("\n").map((line) => line.split(","));
  return lines.map((line) => Object.fromEntries(heads.map((head, i) => [head, line[i]])));
}
const nanoseconds = (text) => BigInt(text.replace(".", ""));
const squared = (text) => (text === "" ? 0 : Number(text) ** 2);
function vector(row, name, scale = 1) {
  const [x, y, z] = ["x", "y", "z"].map((axis) => Number(row[`${name}_${axis}`]) * scale);
  return { x, y: -y, z: -z };
}
function near(actual, expected, what) {
  for (const key of Object.keys(expected)) {
    const tolerance = 1e-12 * Math.max(1e-6, Math.abs(expected[key]));
    assert.ok(Math.abs(actual[key] - expected[key]) <= tolerance, `${what}: ${key} is ${actual[key]}, the log has ${expected[key]}`);
  }
}

let first;  // row of the first position of the odometry
const judges = {
  data: ["imu", "sensor_msgs/msg/Imu", (row) => row.rate_rad_s_x || row.specific_force_m_s2_x, (message, row) => {
    const rate = vector(row, "rate_rad_s");
    if (row.yaw_rate_calibrated_rad_s) rate.z = -Number(row.yaw_rate_calibrated_rad_s);
    near(message.angular_velocity, rate, "rate");
    near(message.linear_acceleration, vector(row, "specific_force_m_s2"), "specific force");
    assert.equal(message.orientation_covariance[0], -1);
    assert.equal(message.angular_velocity_covariance[0], squared(row.rate_std_rad_s));
    assert.equal(message.linear_acceleration_covariance[8], squared(row.specific_force_std_m_s2));
  }],
  mag: ["compass", "sensor_msgs/msg/MagneticField", (row) => row.field_body_uT_x, (message, row) => {
    near(message.magnetic_field, vector(row, "field_body_uT", 1e-6), "field");
    if (row.field_std_uT) assert.ok(message.magnetic_field_covariance[4] > 0);
  }],
  fix: ["gps", "sensor_msgs/msg/NavSatFix", () => true, (message, row) => {
    if (row.lat_deg) near(message, { latitude: Number(row.lat_deg), longitude: Number(row.lon_deg) }, "fix");
    assert.equal(message.status.status, ["2d", "3d", "propagated", "hold"].includes(row.fix) ? 0 : -1);
    assert.equal(message.position_covariance[0], squared(row.position_std_m));
  }],
  odometry: ["nav", "nav_msgs/msg/Odometry", (row) => row.heading_rad, (message, row) => {
    const { x, y, z, w } = message.pose.pose.orientation;
    const yaw = Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
    assert.ok(Math.abs(Math.sin(yaw + Number(row.heading_rad) - Math.PI / 2)) < 1e-9, "yaw is 90 degrees less heading");
    const { x: east, y: north, z: up } = message.pose.pose.position;
    assert.equal(up, -Number(row.depth_m));
    if (row.lat_deg) {
      first ??= row;
      assert.ok(Math.abs(north - (row.lat_deg - first.lat_deg) * 111_450) < 5 && Math.abs(east) < 100, `north ${north}, east ${east}`);
      assert.equal(message.pose.covariance[7], squared(row.north_std_m));
    }
    assert.equal(message.pose.covariance[35], squared(row.heading_std_rad));
    assert.equal(message.child_frame_id, "base_link");
  }],
};

const bytes = readFileSync(path);
await zstd.isLoaded;
const reader = await McapIndexedReader.Initialize({
  readable: { size: async () => BigInt(bytes.length), read: async (at, length) => bytes.subarray(Number(at), Number(at + length)) },
  decompressHandlers: { zstd: (chunk, size) => zstd.decompress(chunk, Number(size)) },
});
assert.equal(reader.header.profile, "ros2");
assert.ok(reader.chunkIndexes.length > 0 && reader.chunkIndexes.every(({ compression }) => compression === "zstd"));
for await (const metadata of reader.readMetadata({ name: "rosbag2" })) assert.ok(metadata.metadata.has("ROS_DISTRO"));
for (const { topic, metadata, messageEncoding } of reader.channelsById.values()) {
  assert.equal(messageEncoding, "cdr");
  assert.match(metadata.get("topic_type_hash"), /^RIHS01_[0-9a-f]{64}$/, topic);
  assert.match(metadata.get("offered_qos_profiles"), /^- history: 1\n/, topic);
}

const decoders = new Map();
const found = new Map();
for await (const record of reader.readMessages({ validateCrcs: true })) {
  const channel = reader.channelsById.get(record.channelId);
  const schema = reader.schemasById.get(channel.schemaId);
  if (!decoders.has(schema.id)) {
    assert.equal(schema.encoding, "ros2msg");
    decoders.set(schema.id, new MessageReader(parse(new TextDecoder().decode(schema.data), { ros2: true })));
  }
  const message = decoders.get(schema.id).readMessage(record.data);
  assert.equal(BigInt(message.header.stamp.sec) * 1_000_000_000n + BigInt(message.header.stamp.nanosec ?? message.header.stamp.nsec), record.publishTime, channel.topic);
  if (!found.has(channel.topic)) found.set(channel.topic, []);
  found.get(channel.topic).push({ type: schema.name, message, publishTime: record.publishTime, logTime: record.logTime });
}
assert.equal([...found.values()].reduce((sum, list) => sum + list.length, 0), Number(reader.statistics.messageCount));

let compared = 0;
for (const [topic, list] of found) {
  const name = topic.split("/").at(-1), device = topic.split("/").at(-2);
  if (!(name in judges)) continue;
  const [table, type, has, judge] = judges[name];
  const expected = rows(table).filter((row) => has(row) && (name === "odometry" || row.device === device));
  // Before the north is known there is no odometry.
  const missing = name === "odometry" ? expected.length - list.length : 0;
  assert.equal(list.length, expected.length - missing, topic);
  list.forEach(({ type: found, message, publishTime, logTime }, i) => {
    const row = expected[i + missing];
    assert.equal(found, type);
    assert.equal(publishTime, nanoseconds(row.time_s), `${topic}: time of validity`);
    assert.equal(logTime, nanoseconds(row.arrival_s), `${topic}: arrival`);
    judge(message, row);
    compared++;
  });
}
assert.ok(compared > 100, "nothing to compare");
console.log(`${path}: ${compared} messages of ${found.size} topics agree`);
