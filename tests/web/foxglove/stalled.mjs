// SPDX-License-Identifier: Apache-2.0
// A viewer that does not read misses messages, and is told how many and when; another one misses none.
//   node stalled.mjs BUILD_FOLDER FOLDER
import assert from "node:assert/strict";
import { FakeNavcald } from "./fake_navcald.mjs";
import { Vehicle, eventually } from "./vehicle.mjs";
import { Viewer } from "./viewer.mjs";

// Far more than what the server keeps for a viewer (1 MB) and the buffers of the kernel hold.
const BURSTS = 200, BURST = 200, BYTES = 1000;

const vehicle = new Vehicle(...process.argv.slice(2));
const navcald = new FakeNavcald();
try {
  vehicle.statusPort = await navcald.listen();
  await vehicle.startWeb();
  const reading = new Viewer(vehicle.webPort, ["foxglove.websocket.v1"]);
  const stalled = new Viewer(vehicle.webPort, ["foxglove.sdk.v1"]);
  for (const viewer of [reading, stalled]) await eventually(() => viewer.channels.has("/imu"), "channels");
  // Without a limit for all topics, or for this one.
  const everyRecord = /"rate_Hz":null|"\/imu":null/;
  assert.doesNotMatch(navcald.asked, everyRecord, "not every record is asked for before somebody subscribes");
  for (const viewer of [reading, stalled]) viewer.subscribe("/imu");
  await eventually(() => everyRecord.test(navcald.asked), "every record of /imu is asked for");
  const got = (viewer) => viewer.of("/imu").length;
  navcald.send(1, BYTES);
  for (const viewer of [reading, stalled]) await eventually(() => got(viewer) === 1, "the first message");

  stalled.socket._socket.pause();
  for (let i = 0; i < BURSTS; i++) {
    navcald.send(BURST, BYTES);
    await eventually(() => got(reading) === navcald.count, "all messages for the viewer that reads");
  }
  assert.deepEqual(reading.statuses, []);
  stalled.socket._socket.resume();
  const report = await eventually(() => stalled.statuses.find(({ level }) => level === 1), "a report of what was missed");
  assert.match(report.message, /^\d+ messages were dropped from \d{4}-\d\d-\d\dT[\d:.]+Z to \d{4}-\d\d-\d\dT[\d:.]+Z/);
  const missed = parseInt(report.message, 10);
  assert.equal(got(stalled) + missed, navcald.count, report.message);
  navcald.send(1, BYTES);
  await eventually(() => JSON.parse(stalled.of("/imu").at(-1).text).n === navcald.count, "it goes on");
  assert.equal(await vehicle.stop(vehicle.web), 0);
  console.log(`${navcald.count} messages: ${missed} were dropped for the viewer that did not read, none for the other`);
} catch (error) {
  console.error(error, vehicle.diagnostics());
  process.exitCode = 1;
} finally {
  vehicle.end();
  process.exit();
}
