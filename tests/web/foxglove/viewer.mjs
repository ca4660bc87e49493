// SPDX-License-Identifier: Apache-2.0
// Foxglove's own client of its protocol, as a viewer that keeps what it is told.
import { createRequire } from "node:module";
import WebSocket from "ws";

const { FoxgloveClient } = createRequire(import.meta.url)("@foxglove/ws-protocol");

export class Viewer {
  constructor(port, subprotocols) {
    this.socket = new WebSocket(`ws://127.0.0.1:${port}`, subprotocols, { origin: "https://app.foxglove.dev" });
    this.client = new FoxgloveClient({ ws: this.socket });
    Object.assign(this, { channels: new Map(), statuses: [], times: [], messages: new Map(), topics: new Map(), errors: [] });
    this.client.on("serverInfo", (info) => (this.info = info));
    this.client.on("advertise", (channels) => channels.forEach((channel) => this.channels.set(channel.topic, channel)));
    this.client.on("unadvertise", (ids) => {
      for (const [topic, channel] of this.channels) if (ids.includes(channel.id)) this.channels.delete(topic);
    });
    this.client.on("status", (status) => this.statuses.push(status));
    this.client.on("time", ({ timestamp }) => this.times.push(timestamp));
    this.client.on("error", (error) => this.errors.push(error));
    this.client.on("message", ({ subscriptionId, timestamp, data }) => {
      const topic = this.topics.get(subscriptionId);
      const bytes = Buffer.from(data.buffer, data.byteOffset, data.byteLength);
      this.messages.get(topic).push({ timestamp, bytes, text: bytes.toString("utf8") });
    });
  }
  subscribe(topic) {
    this.messages.set(topic, this.messages.get(topic) ?? []);
    const id = this.client.subscribe(this.channels.get(topic).id);
    this.topics.set(id, topic);
    return id;
  }
  of(topic) {
    return this.messages.get(topic) ?? [];
  }
}
