// SPDX-License-Identifier: Apache-2.0
// Depth, speed, shaft and fins over time (uPlot). Times are those of the records. In a column, null is a gap of the
// line; undefined is only a row that belongs to another topic.
import {$, make, style, svg, write} from './dom.js';
import {degrees} from './format.js';

const SPACING_S = 0.2;
const GAP_S = 10;
const GAP_OF_PLAYING_S = 1; // of real time: frames of a recording that is played fast lie further apart
const MAX_ROWS = 9000;
const REDRAW_MS = 250;

const DASHES = [[], [6, 3], [2, 3]];
const COLORS = ['--reckoned', '--fix', '--simulated'];

const PLOTS = [
  {title: 'Depth, m (downwards)', names: ['estimate', 'gauge'], flip: true, topics: {
    '/nav': (m) => [m.depth_m, undefined], '/imu': (m) => [undefined, m.depth_m], '/depth': (m) => [undefined, m.depth_m]}},
  {title: 'Speed through the water, m/s', names: ['speed'], topics: {'/nav': (m) => [m.speed_m_s]}},
  {title: 'Shaft, rpm', names: ['measured', 'ordered'], topics: {'/motor': (m) => [m.rpm, m.rpm_commanded]}},
  {title: 'Fins, \u00b0', names: ['fin 1', 'fin 2', 'fin 3'], topics: {'/motor': (m) => (m.fins_rad ?? [null, null, null]).map(degrees)}},
];

const utc = (time) => (time == null ? '' : new Date(time * 1000).toISOString().slice(11, 19));
const shown = (value) => (value == null ? '\u2013' : value.toFixed(2).replace('-', '\u2212'));

class Plot {
  constructor(description, parent) {
    this.description = description;
    this.box = make('div');
    this.parent = parent;
    parent.append(this.box);
    this.time = make('li', {class: 'number'});
    this.values = description.names.map(() => make('b', {class: 'number'}));
    const line = (i) => svg('svg', {viewBox: '0 0 32 16', 'aria-hidden': 'true'}, svg('line', {x1: 0, x2: 32, y1: 8, y2: 8, stroke: `var(${COLORS[i]})`, 'stroke-width': 3, 'stroke-dasharray': DASHES[i].map((length) => 2 * length).join(' ')}));
    this.legend = make('ul', {class: 'legend'}, ...description.names.map((name, i) => make('li', {}, line(i), `${name} `, this.values[i])), this.time);
    this.clear();
  }

  clear() {
    this.data = [[], ...this.description.names.map(() => [])];
  }

  take(record, source, gap) {
    const values = this.description.topics[record.topic]?.(record.message);
    const time = record.message.time;
    if (!values || time == null || values.every((value) => value == null)) return;
    if (source && source.device !== record.device) return;
    if (time < (this.data[0].at(-1) ?? -Infinity) - gap) this.clear();
    const times = this.data[0];
    const last = times.at(-1) ?? -Infinity;
    // Another topic's value of nearly the same time stands in the same row.
    if (time - last < SPACING_S) {
      values.forEach((value, i) => {
        if (value !== undefined && this.data[i + 1].at(-1) == null) this.data[i + 1][times.length - 1] = value;
      });
      return;
    }
    if (time - last > gap && times.length > 0) this.#push(last + SPACING_S, values.map(() => null));
    this.#push(time, values);
    if (times.length > MAX_ROWS) for (const column of this.data) column.splice(0, 1000);
  }

  // Puts records that are older than those that it has before them.
  precede(records, take) {
    const live = this.data;
    this.clear();
    for (const record of records) take(record);
    const end = this.data[0].at(-1) ?? -Infinity;
    if (live[0].at(0) - end > GAP_S) this.#push(end + SPACING_S, this.description.names.map(() => null));
    live[0].forEach((time, i) => time > end && this.#push(time, live.slice(1).map((column) => column[i])));
  }

  #push(time, values) {
    this.data[0].push(time);
    values.forEach((value, i) => this.data[i + 1].push(value));
  }

  build() {
    this.chart?.destroy();
    const {title, names, flip} = this.description;
    const axis = {stroke: style('--muted'), grid: {stroke: style('--grid'), width: 1}, ticks: {stroke: style('--grid')}, font: '11px system-ui, sans-serif'};
    this.chart = new uPlot({
      title, width: Math.max(200, this.parent.clientWidth), height: 140, tzDate: (time) => uPlot.tzDate(new Date(time * 1000), 'UTC'),
      cursor: {sync: {key: 'navcal'}, drag: {x: false, y: false}}, legend: {show: false}, hooks: {setCursor: [() => this.#tell()]},
      scales: {x: {time: true, auto: false}, y: {dir: flip ? -1 : 1, range: (_, low, high) => widened(low, high)}},
      axes: [{...axis, space: 56, size: 24, values: (_, times, axisIndex, space, step) => times.map((time) => utc(time).slice(0, step % 60 === 0 ? 5 : 8))}, {...axis, size: 46, space: 22}],
      series: [{}, ...names.map((label, i) => ({label, stroke: style(COLORS[i]), width: 2, dash: DASHES[i], points: {show: false}}))],
    }, this.data, this.box);
    this.legend.remove();
    this.box.append(this.legend);
    this.box.firstChild.setAttribute('role', 'img');
    this.box.firstChild.setAttribute('aria-label', `Plot over time: ${title}: ${names.join(', ')}`);
  }

  draw(span) {
    const end = this.data[0].at(-1);
    if (!this.chart || end == null) return;
    this.chart.setData(this.data, false);
    this.chart.setScale('x', {min: end - span, max: end});
    this.#tell();
  }

  // The values at the cursor, otherwise the newest.
  #tell() {
    const row = this.chart.cursor.idx;
    const value = (column) => (row == null ? column.findLast((one) => one != null) : column[row]);
    write(this.time, row == null ? '' : `at ${utc(this.data[0][row])}`);
    this.values.forEach((span, i) => write(span, shown(value(this.data[i + 1]))));
  }
}

function widened(low, high) {
  if (low == null) return [0, 1];
  const room = Math.max(0.1, (high - low) * 0.1, Math.abs(high) * 0.02);
  return [low - room, high + room];
}

export class Plots {
  constructor(store) {
    this.store = store;
    this.area = $('plot-area');
    this.plots = PLOTS.map((description) => new Plot(description, this.area));
    store.addEventListener('record', (event) => this.take(event.detail));
    store.addEventListener('begin', () => {
      if (store.about.recording) this.plots.forEach((plot) => plot.clear());
    });
    $('plot-span').addEventListener('change', () => this.draw());
    if (store.about.version) this.#recall();
    else store.addEventListener('begin', () => this.#recall(), {once: true});
    let built = 0;
    new ResizeObserver(() => {
      if (this.area.clientWidth === built) return;
      built = this.area.clientWidth;
      this.build();
    }).observe(this.area);
    setInterval(() => {
      if (!document.hidden) this.draw();
    }, REDRAW_MS);
  }

  // The log has what was before the page was opened.
  async #recall() {
    if (this.store.about.recording) return;
    let history;
    try {
      history = await (await fetch('history.json')).json();
    } catch (error) {
      history = {problem: error.message, records: []};
    }
    const records = history.records.map(([topic, device, message]) => ({topic, device, message}));
    for (const plot of this.plots) plot.precede(records, (record) => this.#give(plot, record));
    write($('plot-history'), history.problem ? `What was before the page was opened is not all here: ${history.problem}.` : '');
  }

  take(record) {
    for (const plot of this.plots) this.#give(plot, record);
  }

  #give(plot, record) {
    const role = {'/motor': 'shaft', '/imu': 'depth', '/depth': 'depth'}[record.topic];
    const source = role ? this.store.best(record.topic, role) : null;
    const gap = Math.max(GAP_S, GAP_OF_PLAYING_S * (this.store.play?.speed ?? 0));
    plot.take(record, source, gap);
  }

  build() {
    if (typeof uPlot === 'undefined') return;
    for (const plot of this.plots) plot.build();
    this.draw();
  }

  draw() {
    const span = Number($('plot-span').value);
    for (const plot of this.plots) plot.draw(span);
  }
}
