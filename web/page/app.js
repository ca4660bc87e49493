// SPDX-License-Identifier: Apache-2.0
// navcal's page: draws what came, once for each frame of the display.
import {Calibration} from './calibration.js';
import {Control} from './control.js';
import {$, attribute, make, write} from './dom.js';
import {Events} from './events.js';
import {clock, duration} from './format.js';
import {Link} from './link.js';
import {Numbers} from './numbers.js';
import {Player} from './player.js';
import {Plots} from './plots.js';
import {Store} from './store.js';
import {System} from './system.js';
import {startTheme} from './theme.js';
import {TrackMap} from './track.js';
import {Vehicle} from './vehicle.js';

const store = new Store();
const link = new Link(store);
const vehicle = new Vehicle(store);
const numbers = new Numbers(store);
const map = new TrackMap(store, {heading: () => numbers.heading()?.rad ?? null});
const system = new System(store);
const calibration = new Calibration(store, vehicle);
const events = new Events(store, vehicle);
const control = new Control(store, vehicle);
const player = new Player(store, link);
let plots = null;

// The card whose values come from these topics is marked when all of them are stale.
const CARDS = {track: ['/nav', '/gps'], heading: ['/compass', '/nav'], attitude: ['/compass', '/nav'], motion: ['/nav', '/motor', '/imu', '/depth'], surfacing: ['/nav'], battery: ['/battery', '/power'], ports: ['/health']};
const ages = new Map();
for (const id of Object.keys(CARDS)) {
  const age = make('span', {class: 'age'});
  $(id).querySelector('h2').append(age);
  ages.set(id, age);
}

let isDirty = true;
let mapDrawn = 0;
const dirty = () => (isDirty = true);
for (const kind of ['record', 'begin', 'mark', 'frame', 'snapshot', 'dropped']) store.addEventListener(kind, dirty);
link.addEventListener('change', () => {
  drawLink();
  dirty();
});

function drawLink() {
  const isLost = link.state === 'lost';
  const noDaemon = !store.link.connected && (link.state === 'open' || link.state === 'polling');
  const silence = link.silence();
  const [text, grade] = isLost ? ['LINK LOST', 'bad'] : link.state === 'connecting' ? ['connecting', 'warn'] : noDaemon ? ['NO NAVCALD', 'bad'] : store.about.recording ? ['recording', 'good'] : link.state === 'polling' ? ['live, by polling once a second: no WebSocket gets through', 'warn'] : ['live', 'good'];
  write($('link-state'), text);
  attribute($('link-state'), 'class', `chip ${grade}`);
  const lost = isLost || noDaemon;
  document.body.classList.toggle('lost', lost);
  $('link-lost').hidden = !lost;
  if (!lost) return $('link-lost').replaceChildren();
  const what = isLost ? `LINK LOST: ${link.why}.` : `NO CONNECTION TO NAVCALD: ${store.link.problem}.`;
  const old = store.records.size === 0 ? 'Nothing was received yet.' : `What is shown is old${isLost && silence != null ? `: ${duration(silence)}` : ''}.`;
  // Screen readers hear the words once; the age changes beside them.
  if ($('link-lost').dataset.what !== what || !$('link-lost').firstChild) {
    $('link-lost').dataset.what = what;
    $('link-lost').replaceChildren(make('span', {}, what, ' ', make('b', {'aria-hidden': 'true'}), ' Connecting again by itself.'));
  }
  write($('link-lost').querySelector('b'), old);
}

function drawAges() {
  for (const [id, topics] of Object.entries(CARDS)) {
    const records = topics.flatMap((topic) => store.all(topic));
    const isStale = records.length > 0 && records.every((record) => store.isStale(record));
    $(id).classList.toggle('stale', isStale);
    write(ages.get(id), isStale ? `stale: ${duration(Math.min(...records.map((record) => store.age(record))))} old` : '');
  }
}

function drawClock() {
  const utc = clock(store.utc, true);
  write($('now'), utc ? `${utc} UTC` : 'UTC unknown');
}

const panels = [drawClock, () => system.draw(), () => numbers.draw(), () => calibration.draw(), () => events.draw(), () => player.draw()];

function draw() {
  requestAnimationFrame(draw);
  if (!isDirty) return;
  isDirty = false;
  // What one panel cannot show must not keep the others from showing.
  for (const draw_ of panels) {
    try {
      draw_();
    } catch (error) {
      console.error(error);
    }
  }
  if (performance.now() - mapDrawn < 200) return dirty();
  mapDrawn = performance.now();
  map.draw();
}

store.addEventListener('snapshot', () => {
  drawLink();
  const play = store.play;
  $('mode').hidden = !store.about.recording;
  if (play) write($('mode'), play.file);
  if (store.about.has_track && !map.simulated) fetch('track.json').then((answer) => answer.json()).then((track) => map.setSimulated(track), console.error);
});
setInterval(() => {
  drawLink();
  drawAges();
  control.draw();
}, 500);
// Logs are taken from a browser on the same computer only (web/access.h).
$('audit-link').hidden = !/^(localhost|127(\.\d+){3}|\[::1\])$/.test(location.hostname);
startTheme(() => {
  plots?.build();
  map.draw();
});
new ResizeObserver(dirty).observe($('track-map'));
requestAnimationFrame(draw);

// The plots' library is the largest file: everything else is there before it.
const library = make('script', {src: 'uplot.js'});
library.addEventListener('load', () => {
  document.head.append(make('link', {rel: 'stylesheet', href: 'uplot.css'}));
  plots = new Plots(store);
});
library.addEventListener('error', () => $('plot-area').append(make('p', {class: 'absent'}, 'absent: uplot.js could not be loaded')));
requestAnimationFrame(() => document.head.append(library));
