// SPDX-License-Identifier: Apache-2.0
// What the page knows: the newest record of each topic and device with its age, the events, and the track.

const MAX_POINTS = 4000;
const MAX_EVENTS = 200;

// Points in the order of their times, of bounded number: when there is no room every second one goes.
export class Track {
  constructor() {
    this.clear();
  }
  clear() {
    this.points = [];
    this.spacing = 0.5;
  }
  add(point) {
    const last = this.points.at(-1);
    if (last) {
      if (point[0] < last[0] - 1) this.clear();
      else if (point[0] - last[0] < this.spacing) return;
    }
    if (this.points.length >= MAX_POINTS) {
      this.points = this.points.filter((_, i) => i % 2 === 0);
      this.spacing *= 2;
    }
    this.points.push(point);
  }
}

export class Store extends EventTarget {
  constructor() {
    super();
    this.records = new Map();
    this.previous = new Map();
    this.events = [];
    this.track = new Track();
    this.fixes = new Track();
    this.about = {recording: false, can_change: false, version: '', has_track: false};
    this.link = {connected: false, problem: 'not connected yet'};
    this.play = null;
    this.utc = null; // of the newest record
  }

  take(text) {
    const frame = JSON.parse(text);
    if (frame.link) this.link = frame.link;
    if (frame.play) this.play = frame.play;
    if (frame.kind === 'snapshot') this.#begin(frame);
    for (const [topic, device, message, age] of frame.records ?? []) {
      if (topic === '/event') this.#event(message);
      else this.#record(topic, device ?? '', message, age ?? 0, frame.kind === 'snapshot');
    }
    if (frame.kind === 'dropped') this.dropped = frame.frames;
    this.dispatchEvent(new Event(frame.kind));
  }

  #begin(frame) {
    for (const name of Object.keys(this.about)) this.about[name] = frame[name];
    // Of a recording it is another place, of a live vehicle the same values as before or newer ones.
    this.previous = this.about.recording ? new Map() : this.records;
    this.records = new Map();
    this.utc = null;
    this.events = [];
    for (const event of frame.events) this.#event(event);
    this.takeTracks(frame);
    this.dispatchEvent(new Event('begin'));
  }

  takeTracks(snapshot) {
    for (const name of ['track', 'fixes']) {
      this[name].clear();
      for (const point of snapshot[name]) this[name].add(point);
    }
  }

  #event(message) {
    this.events.unshift(message);
    if (this.events.length > MAX_EVENTS) this.events.pop();
    this.dispatchEvent(new CustomEvent('mark', {detail: message}));
  }

  #record(topic, device, message, age, isOld) {
    const key = `${topic} ${device} ${message.part ?? ''}${topic === '/sensor' ? message.quantity : ''}`;
    const now = performance.now();
    // HEALTH has its time as text.
    if (typeof message.time === 'string') message.time = Date.parse(message.time) / 1000;
    const before = this.records.get(key) ?? this.previous.get(key);
    const record = {topic, device, message, at: now - age * 1000, interval: before?.interval ?? null, before};
    if (before) {
      const interval = (record.at - before.at) / 1000;
      record.interval = before.interval == null ? interval : 0.8 * before.interval + 0.2 * interval;
      before.before = null;
    }
    this.records.set(key, record);
    if (message.time != null && topic !== '/time' && (this.utc == null || message.time > this.utc || this.utc - message.time > 60)) this.utc = message.time;
    if (topic === '/nav' && message.lat != null)
      this.track.add([message.time, message.lat, message.lon, message.north_std_m, message.east_std_m]);
    if (topic === '/gps' && message.lat != null)
      this.fixes.add([message.time, message.lat, message.lon, message.position_std_m, message.position_std_m]);
    const isNews = !isOld || (before && before.message.time !== message.time);
    if (isNews) this.dispatchEvent(new CustomEvent('record', {detail: record}));
  }

  all(topic) {
    return [...this.records.values()].filter((record) => record.topic === topic);
  }

  // The record of the device that serves a role, by HEALTH; without it the first device.
  best(topic, role) {
    const all = this.all(topic);
    const serving = this.record('/health')?.message.sources?.[role];
    return all.find((record) => record.device === serving) ?? all[0] ?? null;
  }

  record(topic) {
    return this.all(topic)[0] ?? null;
  }

  // Seconds since a record came; in a recording, since its time in the recorded time.
  age(record) {
    if (!this.about.recording) return (performance.now() - record.at) / 1000;
    if (this.play == null || record.message.time == null) return 0;
    return Math.max(0, this.play.begin + this.play.position_s - record.message.time);
  }

  // A record is stale after three seconds, or after four of its own intervals where that is longer.
  isStale(record) {
    const usual = this.about.recording ? 1 : (record.interval ?? 0);
    return this.age(record) > Math.max(3, 4 * usual);
  }
}
