// SPDX-License-Identifier: Apache-2.0
// The time bar of a recording.
import {$, attribute, make, write} from './dom.js';
import {clock} from './format.js';

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100, 500];
const SEEK_MS = 100;

const span = (s) => `${Math.floor(s / 3600)}:${String(Math.floor((s % 3600) / 60)).padStart(2, '0')}:${String(Math.floor(s % 60)).padStart(2, '0')}`;

export class Player {
  constructor(store, link) {
    this.store = store;
    this.link = link;
    this.seek = $('seek');
    $('play').addEventListener('click', () => link.send({play: !store.play?.playing}));
    $('speed').addEventListener('change', (event) => link.send({speed: Number(event.target.value)}));
    this.seek.addEventListener('input', () => {
      this.isHeld = true;
      clearTimeout(this.timer);
      this.timer = setTimeout(() => {
        this.isHeld = false;
        link.send({seek: Number(this.seek.value)});
      }, SEEK_MS);
    });
    document.addEventListener('keydown', (event) => {
      if (event.key !== ' ' || event.target !== document.body || !store.about.recording) return;
      event.preventDefault();
      $('play').click();
    });
  }

  draw() {
    const play = this.store.play;
    $('player').hidden = !this.store.about.recording || !play;
    if (!play) return;
    // At a great speed frames lie many seconds apart; the server has the track in full.
    if (this.wasPlaying && !play.playing) fetch('live.json', {cache: 'no-store'}).then((answer) => answer.json()).then((snapshot) => this.store.takeTracks(snapshot), console.error);
    this.wasPlaying = play.playing;
    attribute(this.seek, 'max', play.duration_s.toFixed(1));
    if (!this.isHeld) this.seek.value = play.position_s;
    write($('play'), play.playing ? 'Pause' : 'Play');
    attribute($('play'), 'aria-label', play.playing ? 'Pause' : 'Play');
    attribute(this.seek, 'aria-valuetext', `${span(play.position_s)} of ${span(play.duration_s)}`);
    write($('play-time'), `${span(play.position_s)} / ${span(play.duration_s)} \u2013 ${clock(play.begin + play.position_s, true)} UTC`);
    if (this.shown === play.speed) return;
    this.shown = play.speed;
    const speeds = SPEEDS.includes(play.speed) ? SPEEDS : [...SPEEDS, play.speed].sort((a, b) => a - b);
    $('speed').replaceChildren(...speeds.map((speed) => make('option', {value: speed, selected: speed === play.speed}, `${speed}\u00d7`)));
  }
}
