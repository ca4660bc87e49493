// SPDX-License-Identifier: Apache-2.0
// The calibrators: verdict, coverage, estimate with standard errors, and the commands accept, roll back and start.
import {$, ask, attribute, make, write} from './dom.js';
import {number, words} from './format.js';

const LABELS = ['Calibrator', 'Verdict', 'Coverage', 'Held-out error', 'Estimate', 'Do'];
const GRADES = {in_force: 'good', shadow: '', refused: 'warn'};
const UNITS = [['_deg_s', '\u00b0/s'], ['_deg', '\u00b0'], ['_uT_per_A', '\u00b5T/A'], ['_uT', '\u00b5T'], ['_m_s', 'm/s'], ['_rad_s', 'rad/s'], ['_s', 's']];

function split(name) {
  const [suffix, unit] = UNITS.find(([ending]) => name.endsWith(ending)) ?? ['', ''];
  return [words(name.slice(0, name.length - suffix.length)), unit];
}

// The matrix of the magnetometer is left out: nobody reads it. It is in the log.
function estimateText(one) {
  const names = Object.keys(one.estimate ?? {}).filter((name) => !name.startsWith('matrix_'));
  const known = names.filter((name) => one.estimate[name] != null).map((name) => {
    const [bare, unit] = split(name);
    return `${bare} ${number(one.estimate[name], unit, 3, one.std?.[name])}`.replaceAll(' ', '\u00a0');
  });
  const unknown = names.filter((name) => one.estimate[name] == null).map((name) => split(name)[0]);
  if (unknown.length > 0) known.push(`not known: ${unknown.join(', ')}`);
  return known.join(', ') || 'none yet';
}

function heldOut(one) {
  const [before, after, unit] = one.held_out_before_deg != null ? [one.held_out_before_deg, one.held_out_after_deg, '\u00b0'] : [one.held_out_before_percent, one.held_out_after_percent, '%'];
  return before == null ? 'not judged' : `${number(before, unit, 2)} \u2192 ${number(after, unit, 2)}`;
}

export class Calibration {
  constructor(store, vehicle) {
    this.store = store;
    this.vehicle = vehicle;
    this.rows = new Map();
    $('calibration-table').append(make('thead', {}, make('tr', {}, ...LABELS.map((name) => make('th', {scope: 'col'}, name)))), (this.body = make('tbody')));
    vehicle.addEventListener('change', () => this.#enable());
  }

  draw() {
    const reports = this.store.all('/calib').map((record) => record.message);
    const first = reports[0];
    const heading = first?.heading;
    const rms = heading?.after_rms_deg != null ? ` Heading, held out: ${number(heading.before_rms_deg, '\u00b0', 2)} without, ${number(heading.after_rms_deg, '\u00b0', 2)} with all estimates, ${number(heading.in_force_rms_deg, '\u00b0', 2) ?? 'absent'} with what is in force.` : '';
    write($('calibration-note'), first ? `In force: ${first.name === 'none' ? 'none' : first.name}.${rms}` : 'absent: no report of the calibrators (CALIB) came');
    $('calibration-table').hidden = !first;
    for (const one of reports.flatMap((report) => report.calibrators ?? [])) this.#row(one);
  }

  #row(one) {
    let row = this.rows.get(one.calibrator);
    if (!row) {
      const cells = LABELS.map((label) => make('td', {'data-label': label}, make('span')));
      const button = (label, command) => make('button', {type: 'button', 'aria-label': `${label}: ${words(one.calibrator)}`, onclick: () => this.#do(command, row.one)}, label);
      row = {cells, buttons: [button('Accept', 'accept'), button('Roll back', 'rollback'), button('Start anew', 'start')]};
      cells[5].className = 'actions';
      cells[5].firstChild.append(...row.buttons);
      row.reason = make('span', {class: 'note'});
      row.state = make('span');
      cells[1].firstChild.append(row.state, row.reason);
      this.body.append(make('tr', {'data-calibrator': one.calibrator}, ...cells));
      this.rows.set(one.calibrator, row);
      this.#enable();
    }
    if (row.one === one) return;
    row.one = one;
    const text = [words(one.calibrator), null, number(one.coverage == null ? null : one.coverage * 100, '%', 0) ?? 'absent', heldOut(one),
      estimateText(one)];
    text.forEach((words_, i) => words_ != null && write(row.cells[i].firstChild, words_));
    write(row.state, `${words(one.verdict)}${one.held ? ', held by the operator' : ''}${one.judgement === one.verdict ? '' : `; judged ${words(one.judgement)}`}`);
    attribute(row.state, 'class', GRADES[one.verdict] ?? '');
    write(row.reason, [one.reason, one.manoeuvre].filter(Boolean).join('; '));
  }

  #enable() {
    const why = this.vehicle.refusal();
    for (const {buttons} of this.rows.values()) {
      for (const button of buttons) {
        button.disabled = why !== '';
        attribute(button, 'title', why);
      }
    }
  }

  async #do(command, one) {
    const name = words(one.calibrator);
    if (command === 'start' && !(await ask(`Start ${name} anew? What it has learnt is forgotten.`))) return;
    const request = {command: `calibration.${command}`, calibrator: one.calibrator};
    let answer = await this.vehicle.ask(request);
    if (!answer.ok && command === 'accept' && one.judgement !== 'accepted' && (await ask(`navcald refuses: ${answer.error}. Bring ${name} into force all the same?`)))
      answer = await this.vehicle.ask({...request, force: true});
    write($('calibration-answer'), answer.ok ? `${name}: done${answer.name ? `, in force is ${answer.name}` : ''}` : `${name}: ${answer.error}`);
    attribute($('calibration-answer'), 'class', answer.ok ? 'note good' : 'note bad');
  }
}
