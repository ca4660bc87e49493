// SPDX-License-Identifier: Apache-2.0
// The compass rose with the readings of each ten degrees that the calibrators have, and the deviation curve.
import {$, attribute, svg, write} from './dom.js';
import {bearing, degrees, number} from './format.js';

const RADIUS = 84;
const point = (deg, radius) => [radius * Math.sin((deg * Math.PI) / 180), -radius * Math.cos((deg * Math.PI) / 180)];

export class Rose {
  constructor() {
    this.root = $('rose');
    this.sectors = Array.from({length: 36}, () => svg('path', {fill: 'var(--accent)', 'fill-opacity': 0.45}));
    const ticks = Array.from({length: 36}, (_, i) => {
      const [x1, y1] = point(i * 10, RADIUS);
      const [x2, y2] = point(i * 10, RADIUS + (i % 3 === 0 ? 8 : 4));
      return svg('line', {x1, y1, x2, y2, stroke: 'var(--text)', 'stroke-width': i % 9 === 0 ? 2 : 1});
    });
    const names = ['N', '30', '60', 'E', '120', '150', 'S', '210', '240', 'W', '300', '330'].map((name, i) => {
      const [x, y] = point(i * 30, RADIUS + 19);
      return svg('text', {x, y: y + 4, 'text-anchor': 'middle', 'font-weight': i % 3 === 0 ? 700 : 400}, name);
    });
    this.card = svg('g', {}, svg('circle', {r: RADIUS, fill: 'none', stroke: 'var(--line)'}), ...this.sectors, ...ticks, ...names);
    this.spread = svg('path', {fill: 'var(--fix)', 'fill-opacity': 0.3});
    this.needle = svg('g', {}, svg('path', {d: 'M0 -82L8 12L0 4L-8 12Z', fill: 'var(--fix)', stroke: 'var(--card)', 'stroke-width': 1}));
    this.title = svg('title');
    this.root.replaceChildren(this.title, this.card, this.spread, this.needle);
  }

  coverage(rose) {
    const most = Math.max(1, ...(rose ?? []));
    this.sectors.forEach((sector, i) => {
      const share = rose?.[i] ? Math.sqrt(rose[i] / most) : 0;
      const outer = 24 + (RADIUS - 26) * share;
      const [a, b, c, d] = [point(i * 10 + 0.8, 24), point(i * 10 + 0.8, outer), point(i * 10 + 9.2, outer), point(i * 10 + 9.2, 24)];
      attribute(sector, 'd', share > 0 ? `M${a}L${b}A${outer} ${outer} 0 0 1 ${c}L${d}Z` : '');
    });
    this.covered = rose ? rose.filter((count) => count > 0).length : null;
  }

  heading(rad, stdRad) {
    attribute(this.needle, 'visibility', rad == null ? 'hidden' : 'visible');
    const deg = bearing(degrees(rad));
    if (rad != null) attribute(this.needle, 'transform', `rotate(${deg.toFixed(1)})`);
    const std = degrees(stdRad);
    if (rad == null || !(std > 0.3)) {
      attribute(this.spread, 'd', '');
    } else {
      const half = Math.min(90, std);
      attribute(this.spread, 'd', `M0 0L${point(deg - half, RADIUS)}A${RADIUS} ${RADIUS} 0 0 1 ${point(deg + half, RADIUS)}Z`);
    }
    const covered = this.covered == null ? 'readings of the calibrators absent' : `calibrators have readings in ${this.covered} of 36 sectors`;
    write(this.title, `Heading ${deg == null ? 'absent' : `${deg.toFixed(0)} degrees`}; ${covered}`);
    attribute(this.root, 'aria-label', this.title.textContent);
  }
}

// Deviation = measured less true heading = A + B sin h + C cos h + D sin 2h + E cos 2h, degrees.
const NAMES = ['A', 'B', 'C', 'D', 'E'];
const factors = (deg) => {
  const h = (deg * Math.PI) / 180;
  return [1, Math.sin(h), Math.cos(h), Math.sin(2 * h), Math.cos(2 * h)];
};

export function drawDeviation(calibrator) {
  const root = $('deviation');
  const note = $('deviation-note');
  const estimate = calibrator?.estimate ?? {};
  const values = NAMES.map((name) => estimate[`${name}_deg`] ?? null);
  if (values.slice(1).some((value) => value == null)) {
    root.replaceChildren();
    root.style.display = 'none';
    write(note, calibrator ? `absent: ${calibrator.reason || 'the coefficients are not known yet'}` : 'absent: no calibrator of the compass reports');
    return;
  }
  root.style.display = '';
  const stds = NAMES.map((name) => calibrator.std?.[`${name}_deg`] ?? 0);
  const curve = [];
  for (let deg = 0; deg <= 360; deg += 5) {
    const f = factors(deg);
    const value = f.reduce((sum, factor, i) => sum + factor * (values[i] ?? 0), 0);
    curve.push([deg, value, Math.hypot(...f.map((factor, i) => factor * stds[i]))]);
  }
  const most = Math.max(0.5, ...curve.map(([, value, std]) => Math.abs(value) + std)) * 1.1;
  const x = (deg) => 36 + (deg / 360) * 276;
  const y = (value) => 52 - (value / most) * 44;
  const path = (f) => curve.map((one) => `${x(one[0]).toFixed(1)},${y(f(one)).toFixed(1)}`);
  const label = (text, px, py, anchor) => svg('text', {x: px, y: py, 'text-anchor': anchor, class: 'muted'}, text);
  const top = most > 2 ? Math.floor(most) : Math.floor(most * 10) / 10;
  root.replaceChildren(
    ...[top, 0, -top].flatMap((value) => [svg('line', {x1: 36, x2: 312, y1: y(value), y2: y(value), stroke: 'var(--grid)'}), label(`${value}\u00b0`, 32, y(value) + 3, 'end')]),
    ...[0, 90, 180, 270, 360].map((deg) => label(`${deg}\u00b0`, x(deg), 112, deg === 360 ? 'end' : 'middle')),
    svg('polygon', {points: [...path(([, v, s]) => v + s), ...path(([, v, s]) => v - s).reverse()].join(' '), fill: 'var(--accent)', 'fill-opacity': 0.25}),
    svg('polyline', {points: path(([, v]) => v).join(' '), fill: 'none', stroke: 'var(--accent)', 'stroke-width': 2}));
  const list = NAMES.map((name, i) => `${name}\u202f${values[i] == null ? 'not known' : number(values[i], '\u00b0', 2, stds[i] || null)}`);
  write(note, `${list.join(', ')}; ${calibrator.verdict.replace('_', ' ')}. Band: one standard error.`);
}
