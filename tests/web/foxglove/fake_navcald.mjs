// SPDX-License-Identifier: Apache-2.0
// A status socket with the one topic /imu, which sends as fast as it is told to.
import { createServer } from "node:net";

const SCHEMA = { title: "navcal.Imu", type: "object", properties: { time: { type: "number" } } };

export class FakeNavcald {
  constructor() {
    this.asked = "";
    this.count = 0;
    this.server = createServer((socket) => {
      this.socket = socket;
      socket.on("error", () => {});
      socket.on("data", (data) => {
        if (`${data}`.includes("?RECORDS")) socket.write(`${JSON.stringify({ class: "RECORDS", topics: [{ topic: "/imu", schema_name: "navcal.Imu", schema: SCHEMA }] })}\n`);
        if (`${data}`.includes("?WATCH")) socket.write('{"class":"WATCH","enable":true}\n');
        this.asked = `${data}`.trim().split("\n").at(-1);
      });
    });
  }
  listen() {
    return new Promise((resolve) => this.server.listen(0, "127.0.0.1", () => resolve(this.server.address().port)));
  }
  /** `count` records of about `bytes` bytes each. */
  send(count, bytes) {
    const filling = "x".repeat(bytes);
    let lines = "";
    for (let i = 0; i < count; i++) {
      const seconds = 1_700_000_000 + ++this.count / 1000;
      lines += `{"class":"RECORD","topic":"/imu","device":"imu","time":${seconds.toFixed(9)},"message":{"time":${seconds.toFixed(9)},"n":${this.count},"filling":"${filling}"}}\n`;
    }
    this.socket.write(lines);
  }
}
