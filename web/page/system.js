// SPDX-License-Identifier: Apache-2.0
// Alarms, ports with their rates and faults, clock, log and service.
import {$, Values, attribute, make, write} from './dom.js';
import {bytes, duration, number, seconds, words} from './format.js';

const GRADES = {running: 'good', silent: 'bad', no_frames: 'bad', noisy: 'warn', away: 'bad', off: ''};
const SYMBOLS = {good: '\u2713', warn: '!', bad: '\u2717', '': '\u2013'};

export class System {
  constructor(store) {
    this.store = store;
    this.values = new Values($('system-values'));
    this.rows = new Map();
    $('ports-table').append(
      make('thead', {}, make('tr', {}, ...['Port', 'State', 'Bytes', 'Frames', 'Samples', 'Faults', 'Clock of the device'].map((name) => make('th', {scope: 'col'}, name)))),
      (this.body = make('tbody')));
    store.addEventListener('record', (event) => {
      if (event.detail.topic === '/health') this.#rates(event.detail.message);
    });
    this.counts = new Map();
  }

  // Rates are differences of counters between two reports, by the reports' own times.
  #rates(health) {
    for (const port of health.ports ?? []) {
      const now = {time: health.time ?? null, uptime: health.uptime_s, bytes: port.bytes, frames: port.frames, samples: port.samples};
      const before = this.counts.get(port.device)?.now;
      const span = before && health.uptime_s != null ? health.uptime_s - before.uptime : 0;
      // Reports that a change of state causes come at any time: too short a span gives no rate.
      if (span > 0 && span < 0.5) continue;
      const rate = (name) => (span > 0 && now[name] >= before[name] ? (now[name] - before[name]) / span : null);
      this.counts.set(port.device, {now, rates: {bytes: rate('bytes'), frames: rate('frames'), samples: rate('samples')}});
    }
  }

  draw() {
    const health = this.store.all('/health').map((record) => record.message);
    const alarms = this.#alarms(health);
    this.#title(health[0]?.vehicle, alarms);
    this.#ports(health.flatMap((one) => one.ports ?? []), health.length > 0);
    this.#service(health[0]);
  }

  // Several vehicles may be open in as many tabs: the title tells which one this is, and whether it needs attention.
  #title(vehicle, alarms) {
    const name = vehicle?.name || vehicle?.id;
    write($('vehicle'), name ?? 'navcal');
    const title = name ? `${name} \u2013 navcal` : 'navcal';
    const shown = alarms > 0 ? `\u26a0 ALARM \u2013 ${title}` : title;
    if (document.title !== shown) document.title = shown;
  }

  // Number of alarms.
  #alarms(health) {
    const alarms = health.flatMap((one) => one.alarms ?? []);
    const text = alarms.map((alarm) => `${words(alarm.alarm).toUpperCase()}${alarm.device ? ` (${alarm.device})` : ''}`);
    const known = health.length > 0;
    write($('alarm-state'), !known ? 'alarms unknown' : text.length === 0 ? 'no alarm' : `${text.length} ALARM${text.length > 1 ? 'S' : ''}`);
    attribute($('alarm-state'), 'class', `chip ${!known ? '' : text.length === 0 ? 'good' : 'bad'}`);
    const key = text.join('\n');
    if (key === this.alarmsShown) return text.length;
    this.alarmsShown = key;
    $('alarms').hidden = text.length === 0;
    $('alarms').replaceChildren(...(text.length === 0 ? [] : [make('span', {}, `\u26a0 ALARM: ${text.join(', ')}`)]));
    return text.length;
  }

  #ports(ports, isKnown) {
    write($('ports-note'), isKnown ? (ports.length === 0 ? 'absent: no ports are configured' : '') : 'absent: no report of the ports (HEALTH) came; logs of captures have none');
    $('ports-table').hidden = ports.length === 0;
    for (const port of ports) this.#row(port);
    const names = new Set(ports.map((port) => port.device));
    for (const [name, row] of this.rows) {
      if (names.has(name)) continue;
      row.line.remove();
      this.rows.delete(name);
    }
  }

  #row(port) {
    let row = this.rows.get(port.device);
    if (!row) {
      row = {cells: ['Port', 'State', 'Bytes', 'Frames', 'Samples', 'Faults', 'Clock of the device'].map((label) => make('td', {'data-label': label}, make('span')))};
      row.line = make('tr', {'data-port': port.device}, ...row.cells);
      this.body.append(row.line);
      this.rows.set(port.device, row);
    }
    const rates = this.counts.get(port.device)?.rates ?? {};
    const rate = (value, unit, digits) => (value == null ? '' : ` (${number(value, unit, digits)})`);
    const grade = GRADES[port.state] ?? 'warn';
    const faults = [['bad', port.bad], ['out of range', port.out_of_range], ['gaps', port.gaps], ['lost', port.lost], ['repeated', port.repeated], ['skipped bytes', port.skipped]].filter(([, count]) => count > 0).map(([name, count]) => `${count} ${name}`);
    const deviceClock = port.clock;
    const text = [
      `${port.device} \u2013 ${port.protocol}`,
      `${SYMBOLS[grade]} ${words(port.state)}${port.reason ? `: ${port.reason}` : ''}`,
      `${bytes(port.bytes)}${rate(rates.bytes, 'B/s', 0)}`,
      `${port.frames}${rate(rates.frames, '/s', 1)}`,
      `${port.samples}${rate(rates.samples, '/s', 1)}`,
      faults.length > 0 ? faults.join(', ') : 'none',
      deviceClock?.locked ? `jitter ${seconds(deviceClock.jitter_s) ?? 'absent'}${deviceClock.skew_ppm == null ? '' : `, ${number(deviceClock.skew_ppm, 'ppm', 0, deviceClock.skew_std_ppm)}`}` : 'not locked'];
    row.cells.forEach((cell, i) => write(cell.firstChild, text[i]));
    attribute(row.cells[1].firstChild, 'class', grade);
    attribute(row.cells[5].firstChild, 'class', faults.length > 0 ? 'warn' : '');
  }

  #service(health) {
    const list = this.values;
    const time = this.store.record('/time')?.message;
    const sources = {none: 'UTC is not known', file: 'from the recording', system: 'system clock, not synchronised', 'system-synchronised': 'system clock, synchronised', gps: 'GPS'};
    list.set('UTC from', time ? sources[time.source] ?? time.source : null, time ? (time.bound == null ? 'error bound not known' : `to within ${seconds(time.bound)}`) : 'navcald tells changes only, and none came since the server started', time?.source === 'none' ? 'warn' : '');
    const log = health?.log;
    const noHealth = 'no HEALTH came';
    list.set('log', log ? words(log.enabled === false ? 'off' : log.state) : null, log ? [log.reason, log.file?.split('/').pop()].filter(Boolean).join('; ') : noHealth, !log ? '' : log.state === 'writing' ? 'good' : 'warn');
    list.set('log size', log?.bytes == null ? null : bytes(log.bytes), log?.bytes == null ? noHealth : `${bytes(log.synced ?? 0)} safe on the disk, ${log.queued ?? 0} bytes wait${log.lost > 0 ? `, ${log.lost} records LOST` : ''}`, log?.lost > 0 ? 'bad' : '');
    const vehicle = health?.vehicle;
    if (vehicle) list.set('vehicle', vehicle.name || vehicle.id || 'not named', `${vehicle.name && vehicle.id ? `id ${vehicle.id}; ` : ''}configuration ${vehicle.config_crc32c}`);
    list.set('navcald runs', duration(health?.uptime_s), health ? '' : noHealth);
    list.set('clients of navcald', health?.clients == null ? null : String(health.clients), health ? (health.client_dropped > 0 ? `${health.client_dropped} reports dropped for slow ones` : '') : noHealth);
    const field = health?.earth_field;
    list.set('declination', number(field?.declination, '\u00b0', 2), field?.declination == null ? 'not known' : `from the ${field.declination_source}`);
    if (health?.remote) list.set('remote link', `operator ${health.remote.operator}`, `${(100 * (health.remote.loss ?? 0)).toFixed(0)}\u202f% of frames lost`, health.remote.operator === 'dead' ? 'bad' : '');
    if (this.store.dropped) list.set('frames this page missed', String(this.store.dropped), 'the browser or its line was too slow', 'warn');
    list.set('navcal', this.store.about.version || null);
  }
}
