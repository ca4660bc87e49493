// SPDX-License-Identifier: Apache-2.0
// Artificial horizon: roll positive starboard down, pitch positive nose up.
import {$, attribute, svg} from './dom.js';
import {degrees} from './format.js';

const PIXELS_PER_DEGREE = 2.2;

export class Horizon {
  constructor() {
    this.root = $('horizon');
    const ladder = [-30, -20, -10, 10, 20, 30].flatMap((deg) => {
      const y = -deg * PIXELS_PER_DEGREE;
      return [svg('line', {x1: -20, x2: 20, y1: y, y2: y, stroke: 'var(--text)'}), svg('text', {x: 24, y: y + 3}, String(Math.abs(deg)))];
    });
    this.world = svg('g', {},
      svg('rect', {x: -300, y: -400, width: 600, height: 400, fill: 'var(--sky)'}),
      svg('rect', {x: -300, y: 0, width: 600, height: 400, fill: 'var(--sea)'}),
      svg('line', {x1: -300, x2: 300, y1: 0, y2: 0, stroke: 'var(--text)', 'stroke-width': 1.5}), ...ladder);
    const clip = svg('clipPath', {id: 'horizon-clip'}, svg('circle', {r: 92}));
    this.view = svg('g', {'clip-path': 'url(#horizon-clip)'}, this.world);
    this.none = svg('text', {'text-anchor': 'middle', y: 4}, 'absent');
    const scale = [-60, -45, -30, -15, 0, 15, 30, 45, 60].map((deg) => svg('line', {y1: -92, y2: deg === 0 ? -82 : -87, stroke: 'var(--text)', 'stroke-width': 1.5, transform: `rotate(${deg})`}));
    this.pointer = svg('path', {d: 'M0 -81L5 -71H-5Z', fill: 'var(--fix)', stroke: 'var(--card)'});
    this.root.replaceChildren(svg('defs', {}, clip), this.view, svg('circle', {r: 92, fill: 'none', stroke: 'var(--line)', 'stroke-width': 2}), ...scale, this.pointer,
      svg('path', {d: 'M-46 0H-16L-8 8M46 0H16L8 8', fill: 'none', stroke: 'var(--fix)', 'stroke-width': 4}), svg('circle', {r: 3, fill: 'var(--fix)'}), this.none);
  }

  show(rollRad, pitchRad) {
    const isKnown = rollRad != null && pitchRad != null;
    attribute(this.view, 'visibility', isKnown ? 'visible' : 'hidden');
    attribute(this.pointer, 'visibility', isKnown ? 'visible' : 'hidden');
    attribute(this.none, 'visibility', isKnown ? 'hidden' : 'visible');
    if (!isKnown) return attribute(this.root, 'aria-label', 'Artificial horizon: absent');
    const roll = degrees(rollRad);
    const pitch = degrees(pitchRad);
    attribute(this.world, 'transform', `rotate(${(-roll).toFixed(1)}) translate(0 ${(pitch * PIXELS_PER_DEGREE).toFixed(1)})`);
    attribute(this.pointer, 'transform', `rotate(${(-roll).toFixed(1)})`);
    attribute(this.root, 'aria-label', `Artificial horizon: roll ${roll.toFixed(0)}, pitch ${pitch.toFixed(0)} degrees`);
  }
}
