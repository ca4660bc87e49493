// SPDX-License-Identifier: Apache-2.0
// Remote control: the lease of the motor, orders by sliders, and a stop. Orders are repeated while the lease is held,
// because navcald makes the vehicle safe when none comes.
import {$, attribute, make, write} from './dom.js';
import {number} from './format.js';

const ORDER_MS = 200;
const TIMEOUT_S = 1;
const OPERATOR_PRIORITY = 2;

export class Control {
  constructor(store, vehicle) {
    this.store = store;
    this.vehicle = vehicle;
    this.lease = null;
    this.isAsking = false;
    this.#build();
    vehicle.addEventListener('change', () => this.#changed());
    window.addEventListener('blur', () => this.release('the window lost the focus'));
    window.addEventListener('pagehide', () => this.release('the page was left'));
    document.addEventListener('visibilitychange', () => document.hidden && this.release('the page was hidden'));
    document.addEventListener('keydown', (event) => {
      if (event.key !== 'Escape' || !this.lease) return;
      event.preventDefault();
      this.release('Escape');
    });
    this.#changed();
  }

  #build() {
    const slider = (name, label, most, step, unit) => {
      const range = make('input', {type: 'range', min: -most, max: most, step, value: 0, 'aria-label': `${label}, ${unit}`, id: `order-${name}`});
      const box = make('input', {type: 'number', min: -most, max: most, step, value: 0, 'aria-label': `${label}, ${unit}, as a number`});
      range.addEventListener('input', () => (box.value = range.value));
      box.addEventListener('input', () => (range.value = box.value));
      return {label: make('label', {for: `order-${name}`}, `${label}, ${unit}`), range, box};
    };
    this.orders = {shaft: slider('shaft', 'Shaft', 1200, 10, 'rpm'), fin1: slider('fin1', 'Fin 1', 25, 1, '\u00b0'), fin2: slider('fin2', 'Fin 2', 25, 1, '\u00b0'), fin3: slider('fin3', 'Fin 3', 25, 1, '\u00b0')};
    this.token = make('input', {type: 'password', autocomplete: 'off', id: 'token', minlength: 1});
    this.unlock = make('form', {onsubmit: (event) => {
      event.preventDefault();
      this.vehicle.unlock(this.token.value.trim());
      this.token.value = '';
    }}, make('label', {class: 'grow', for: 'token'}, 'Token ', this.token), make('button', {}, 'Unlock'));
    this.state = make('p', {class: 'note', role: 'status', id: 'control-state'});
    this.answer = $('control-answer');
    this.stop = $('stop');
    this.stop.addEventListener('click', () => this.halt());
    this.take = make('button', {type: 'button', id: 'take', onclick: () => this.#take()}, 'Take charge');
    this.give = make('button', {type: 'button', id: 'give', onclick: () => this.release('released')}, 'Release');
    this.lock = make('button', {type: 'button', id: 'lock', onclick: () => this.vehicle.lock()}, 'Lock');
    const sliders = make('div', {class: 'sliders'}, ...Object.values(this.orders).flatMap(({label, range, box}) => [label, range, box]));
    this.panel = make('div', {}, make('p', {}, this.take, ' ', this.give, ' ', this.lock), sliders,
      make('p', {class: 'note'}, 'The order is sent five times a second. Escape, STOP, or leaving this window gives the motor back, and navcald makes it safe. Limits are those of navcald, which refuses what is beyond them.'));
    $('control-body').append(this.unlock, this.state, this.panel);
  }

  #changed() {
    const why = this.vehicle.refusal();
    const isLocked = why !== '';
    if (isLocked && this.lease) this.#lost('the connection ended: navcald makes the motor safe');
    this.unlock.hidden = !isLocked || this.store.about.recording || !this.store.about.can_change;
    this.panel.hidden = $('stop-bar').hidden = isLocked && (this.store.about.recording || !this.store.about.can_change);
    write($('stop-why'), why);
    for (const button of [this.stop, this.take, this.lock]) {
      button.disabled = isLocked;
      attribute(button, 'title', why);
    }
    this.#show();
  }

  #show() {
    const has = this.lease != null;
    this.give.disabled = !has;
    this.take.disabled = has || this.vehicle.refusal() !== '';
    for (const {range, box} of Object.values(this.orders)) range.disabled = box.disabled = !has;
  }

  // Each second: who is in charge, as navcald reports.
  draw() {
    const why = this.vehicle.refusal();
    const motor = this.store.record('/health')?.message.motor;
    const sent = motor?.shaft_rpm == null ? 'nothing sent yet' : `sent: shaft ${number(motor.shaft_rpm, 'rpm', 0)}, fins ${motor.fins_deg?.map((deg) => number(deg, '\u00b0', 0)).join(' ') ?? 'absent'}${motor.safe ? ' (the safe state)' : ''}`;
    const report = motor ? `${motor.holder ? `In charge: ${motor.holder} (priority ${motor.priority})` : 'Nobody is in charge'}; ${sent}.` : 'navcald has no motor card that takes orders.';
    write(this.state, why ? `${why} ${motor ? report : ''}` : this.lease ? `You are in charge. ${report}` : report);
  }

  #say(text) {
    write(this.answer, text);
  }

  async #take() {
    const answer = await this.vehicle.ask({command: 'motor.lease', holder: 'navcal-web', priority: OPERATOR_PRIORITY, timeout_s: TIMEOUT_S});
    if (!answer.ok) return this.#say(answer.error);
    if (document.hidden || !document.hasFocus()) {
      await this.vehicle.ask({command: 'motor.release', lease: answer.lease});
      return this.#say('Given back: the window has not the focus.');
    }
    this.lease = answer.lease;
    this.#say('');
    for (const {range, box} of Object.values(this.orders)) range.value = box.value = 0;
    this.#show();
    this.orders.shaft.range.focus();
    this.timer = setInterval(() => this.#order(), ORDER_MS);
    this.#order();
  }

  async #order() {
    // The answer to the one before is still under way: another would only wait behind it.
    if (!this.lease || this.isAsking) return;
    this.isAsking = true;
    const value = (name) => Number(this.orders[name].range.value);
    const lease = this.lease;
    const answer = await this.vehicle.ask({command: 'motor.order', lease, shaft_rpm: value('shaft'), fins_deg: [value('fin1'), value('fin2'), value('fin3')]});
    this.isAsking = false;
    if (this.lease !== lease) return;
    if (answer.ok) return this.#say('');
    this.#say(answer.error);
    if (/lease|preempted|stopped by/.test(answer.error)) this.#lost(answer.error);
  }

  #lost(why) {
    clearInterval(this.timer);
    this.lease = null;
    this.#say(`You are no longer in charge: ${why}.`);
    this.#show();
  }

  release(why) {
    if (!this.lease) return;
    const lease = this.lease;
    this.#lost(why);
    this.vehicle.ask({command: 'motor.release', lease}).then((answer) => answer.ok || this.#say(answer.error));
  }

  // Whoever is in charge.
  async halt() {
    if (this.lease) this.#lost('STOP');
    const answer = await this.vehicle.ask({command: 'motor.stop', by: 'navcal-web'});
    this.#say(answer.ok ? 'Stopped: the safe state was ordered, and nobody is in charge.' : `NOT stopped: ${answer.error}`);
  }
}
