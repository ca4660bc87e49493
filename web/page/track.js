// SPDX-License-Identifier: Apache-2.0
// The track on a canvas, north up: fixes, dead reckoning with its error ellipse, and a simulated track.
import {$, make, style, svg, write} from './dom.js';

const METRES_PER_DEGREE = 111320; // of latitude; the sizes below are for the eye
const NICE = [1, 2, 5];

export class TrackMap {
  constructor(store, shapes) {
    this.store = store;
    this.shapes = shapes;
    this.canvas = $('track-map');
    this.zoom = 1;
    this.pan = [0, 0]; // metres north, east of the middle of what is shown
    this.follow = false;
    this.simulated = null;
    this.#legend();
    this.#listen();
  }

  setSimulated(track) {
    this.simulated = track;
    this.#legend();
  }

  #legend() {
    const line = (color, dash) => svg('svg', {viewBox: '0 0 32 16', 'aria-hidden': 'true'}, svg('line', {x1: 0, x2: 32, y1: 8, y2: 8, stroke: `var(${color})`, 'stroke-width': 3, 'stroke-dasharray': dash}));
    const dot = svg('svg', {viewBox: '0 0 32 16', 'aria-hidden': 'true'}, svg('path', {d: 'M10 8h12M16 2v12', stroke: 'var(--fix)', 'stroke-width': 3}));
    const items = [make('li', {}, dot, 'fixes'), make('li', {}, line('--reckoned', ''), 'navigation, with the ellipse of one standard error')];
    if (this.simulated) items.push(make('li', {}, line('--simulated', '6 4'), this.simulated.unit === 'm' ? 'simulated, laid at the first position' : 'simulated'));
    $('track-legend').replaceChildren(...items);
  }

  #listen() {
    const actions = {in: () => this.#scale(1.5), out: () => this.#scale(1 / 1.5), fit: () => this.#fit(), follow: () => this.#setFollow(!this.follow)};
    for (const button of document.querySelectorAll('[data-map]')) button.addEventListener('click', actions[button.dataset.map]);
    const move = (north, east) => {
      this.#setFollow(false);
      this.pan = [this.pan[0] + north, this.pan[1] + east];
    };
    this.canvas.addEventListener('keydown', (event) => {
      const step = 40 / (this.scale ?? 1);
      const keys = {'+': actions.in, '-': actions.out, 0: actions.fit, ArrowUp: () => move(step, 0), ArrowDown: () => move(-step, 0), ArrowLeft: () => move(0, -step), ArrowRight: () => move(0, step)};
      if (!keys[event.key]) return;
      event.preventDefault();
      keys[event.key]();
      this.draw();
    });
    this.canvas.addEventListener('wheel', (event) => {
      if (!event.ctrlKey && document.activeElement !== this.canvas) return;
      event.preventDefault();
      this.#scale(event.deltaY < 0 ? 1.2 : 1 / 1.2);
    }, {passive: false});
    this.canvas.addEventListener('pointerdown', (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      this.drag = [event.clientX, event.clientY];
    });
    this.canvas.addEventListener('pointermove', (event) => {
      if (!this.drag) return;
      move((event.clientY - this.drag[1]) / this.scale, -(event.clientX - this.drag[0]) / this.scale);
      this.drag = [event.clientX, event.clientY];
      this.draw();
    });
    for (const end of ['pointerup', 'pointercancel']) this.canvas.addEventListener(end, () => (this.drag = null));
    this.canvas.style.touchAction = 'pan-y pinch-zoom';
  }

  #scale(factor) {
    this.zoom = Math.min(1e4, Math.max(0.1, this.zoom * factor));
    this.draw();
  }

  #fit() {
    this.zoom = 1;
    this.pan = [0, 0];
    this.#setFollow(false);
    this.draw();
  }

  #setFollow(follow) {
    this.follow = follow;
    document.querySelector('[data-map="follow"]').setAttribute('aria-pressed', follow);
  }

  // Metres north and east of the first position.
  #plane(points) {
    const [lat, lon] = this.origin;
    const east = METRES_PER_DEGREE * Math.cos((lat * Math.PI) / 180);
    return points.map(([, a, o, northStd, eastStd]) => [(a - lat) * METRES_PER_DEGREE, (o - lon) * east, northStd, eastStd]);
  }

  #lines() {
    const {track, fixes} = this.store;
    const first = track.points[0] ?? fixes.points[0];
    if (!first) return null;
    this.origin = [first[1], first[2]];
    const simulated = !this.simulated ? [] : this.simulated.unit === 'm' ? this.simulated.points : this.#plane(this.simulated.points.map((point) => [0, ...point]));
    return {track: this.#plane(track.points), fixes: this.#plane(fixes.points), simulated};
  }

  #view(lines, width, height) {
    let [north, south, east, west] = [-Infinity, Infinity, -Infinity, Infinity];
    for (const points of Object.values(lines)) {
      for (const [n, e] of points) {
        north = Math.max(north, n);
        south = Math.min(south, n);
        east = Math.max(east, e);
        west = Math.min(west, e);
      }
    }
    const margin = 36;
    const span = Math.max(10, (north - south) / Math.max(0.2, (height - 2 * margin) / width), east - west);
    this.scale = ((width - 2 * margin) / span) * this.zoom;
    const last = lines.track.at(-1) ?? lines.fixes.at(-1);
    const middle = this.follow && last ? last : [(north + south) / 2 + this.pan[0], (east + west) / 2 + this.pan[1]];
    return ([n, e]) => [width / 2 + (e - middle[1]) * this.scale, height / 2 - (n - middle[0]) * this.scale];
  }

  draw() {
    const ratio = window.devicePixelRatio || 1;
    const width = this.canvas.clientWidth;
    const height = this.canvas.clientHeight;
    if (width === 0) return;
    if (this.canvas.width !== Math.round(width * ratio)) this.canvas.width = Math.round(width * ratio);
    if (this.canvas.height !== Math.round(height * ratio)) this.canvas.height = Math.round(height * ratio);
    const to = this.canvas.getContext('2d');
    to.setTransform(ratio, 0, 0, ratio, 0, 0);
    to.clearRect(0, 0, width, height);
    to.font = '12px system-ui, sans-serif';
    const lines = this.#lines();
    if (!lines) {
      to.fillStyle = style('--muted');
      to.textAlign = 'center';
      to.fillText('No position yet: there was no fix.', width / 2, height / 2);
      return this.#say('No position yet.');
    }
    const at = this.#view(lines, width, height);
    this.#grid(to, at, width, height);
    this.#polyline(to, lines.simulated, at, '--simulated', [6, 4]);
    this.#ellipses(to, lines.track, at);
    this.#polyline(to, lines.track, at, '--reckoned', []);
    this.#crosses(to, lines.fixes, at);
    this.#vehicle(to, lines.track.at(-1) ?? lines.fixes.at(-1), at);
    this.#say(`Track with ${lines.track.length} positions and ${lines.fixes.length} fixes. Plus and minus zoom, arrows move, 0 shows all.`);
  }

  #say(text) {
    if (this.canvas.getAttribute('aria-label') !== text) this.canvas.setAttribute('aria-label', text);
  }

  #grid(to, at, width, height) {
    let step = 1;
    for (let i = 0; step * this.scale < 70; ++i) step = NICE[i % 3] * 10 ** Math.floor(i / 3);
    const [x0, y0] = at([0, 0]);
    const pixels = step * this.scale;
    to.strokeStyle = style('--grid');
    to.lineWidth = 1;
    to.setLineDash([]);
    to.beginPath();
    for (let x = x0 % pixels; x < width; x += pixels) to.rect(Math.round(x) + 0.5, -1, 0, height + 2);
    for (let y = y0 % pixels; y < height; y += pixels) to.rect(-1, Math.round(y) + 0.5, width + 2, 0);
    to.stroke();
    to.strokeStyle = to.fillStyle = style('--text');
    to.lineWidth = 2;
    to.beginPath();
    to.moveTo(12, height - 16);
    to.lineTo(12, height - 12);
    to.lineTo(12 + pixels, height - 12);
    to.lineTo(12 + pixels, height - 16);
    to.moveTo(20, 34);
    to.lineTo(20, 14);
    to.lineTo(16, 21);
    to.moveTo(20, 14);
    to.lineTo(24, 21);
    to.stroke();
    to.textAlign = 'left';
    to.fillText(step >= 1000 ? `${step / 1000} km` : `${step} m`, 16, height - 18);
    to.fillText('N', 30, 26);
  }

  #polyline(to, points, at, color, dash) {
    to.strokeStyle = style(color);
    to.lineWidth = 2.2;
    to.setLineDash(dash);
    to.beginPath();
    points.forEach((point, i) => (i === 0 ? to.moveTo(...at(point)) : to.lineTo(...at(point))));
    to.stroke();
    to.setLineDash([]);
  }

  #ellipses(to, points, at) {
    to.strokeStyle = to.fillStyle = style('--reckoned');
    const every = Math.max(1, Math.floor(points.length / 24));
    for (let i = points.length - 1; i >= 0; i -= every) {
      const [, , north, east] = points[i];
      if (!(north > 0) || !(east > 0)) continue;
      const isLast = i === points.length - 1;
      to.beginPath();
      to.ellipse(...at(points[i]), east * this.scale, north * this.scale, 0, 0, 2 * Math.PI);
      to.globalAlpha = 0.2;
      if (isLast) to.fill();
      to.globalAlpha = isLast ? 1 : 0.25;
      to.lineWidth = isLast ? 1.5 : 1;
      to.stroke();
      to.globalAlpha = 1;
    }
  }

  #crosses(to, points, at) {
    to.strokeStyle = style('--fix');
    to.lineWidth = 1.6;
    to.beginPath();
    for (const point of points) {
      const [x, y] = at(point);
      to.moveTo(x - 3, y);
      to.lineTo(x + 3, y);
      to.moveTo(x, y - 3);
      to.lineTo(x, y + 3);
    }
    to.stroke();
  }

  #vehicle(to, point, at) {
    if (!point) return;
    const heading = this.shapes.heading();
    to.save();
    to.translate(...at(point));
    to.fillStyle = style('--text');
    to.strokeStyle = style('--card');
    to.lineWidth = 1.5;
    to.beginPath();
    if (heading == null) {
      to.arc(0, 0, 5, 0, 2 * Math.PI);
    } else {
      to.rotate(heading);
      to.moveTo(0, -11);
      to.lineTo(6, 8);
      to.lineTo(0, 4);
      to.lineTo(-6, 8);
      to.closePath();
    }
    to.fill();
    to.stroke();
    to.restore();
  }
}
