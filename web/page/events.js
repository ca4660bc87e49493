// SPDX-License-Identifier: Apache-2.0
// Events, newest first, and the operator's marks.
import {$, attribute, make, write} from './dom.js';
import {clock} from './format.js';

const GRADES = {info: '', warning: 'warn', error: 'bad', alarm: 'bad'};

export class Events {
  constructor(store, vehicle) {
    this.store = store;
    this.list = $('event-list');
    this.isStale = true;
    for (const kind of ['mark', 'begin']) store.addEventListener(kind, () => (this.isStale = true));
    $('mark').addEventListener('submit', async (event) => {
      event.preventDefault();
      const text = $('mark-text').value.trim();
      if (text === '') return;
      const answer = await vehicle.ask({command: 'event', text});
      write($('mark-answer'), answer.ok ? 'The mark is in the log.' : answer.error);
      attribute($('mark-answer'), 'class', answer.ok ? 'note good' : 'note bad');
      if (answer.ok) $('mark-text').value = '';
    });
    const enable = () => {
      const why = vehicle.refusal();
      $('mark').hidden = store.about.recording;
      $('mark-send').disabled = $('mark-text').disabled = why !== '';
      write($('mark-answer'), why);
    };
    vehicle.addEventListener('change', enable);
    enable();
  }

  draw() {
    if (!this.isStale) return;
    this.isStale = false;
    const items = this.store.events.map((event) => make('li', {}, make('time', {}, clock(event.time) ?? 'no UTC'), make('b', {class: GRADES[event.severity] ?? ''}, `${event.severity === 'info' ? '' : `${event.severity.toUpperCase()} `}${event.name}`), [event.port, event.message].filter(Boolean).join(': ')));
    this.list.replaceChildren(...(items.length > 0 ? items : [make('li', {class: 'absent'}, 'no event yet')]));
  }
}
