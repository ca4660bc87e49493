// SPDX-License-Identifier: Apache-2.0
// Small helpers for the document. Text that has not changed is not written: a screen reader stays quiet, and nothing
// is laid out again.

export const $ = (id) => document.getElementById(id);

export function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false && value != null) element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

export function svg(tag, attributes = {}, ...children) {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

export function write(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

export function attribute(element, name, value) {
  if (element.getAttribute(name) !== String(value)) element.setAttribute(name, value);
}

export function style(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

// A list of names and values that keeps its elements from one writing to the next.
export class Values {
  constructor(list) {
    this.list = list;
    this.rows = new Map();
  }

  // Takes away all rows but that of `name`.
  clear(name) {
    for (const [other, row] of this.rows) {
      if (other === name) continue;
      row.value.parentElement.remove();
      this.rows.delete(other);
    }
  }

  // `value` null: absent, and `note` is the reason; otherwise `note` stands below the value.
  set(name, value, note = '', grade = '') {
    let row = this.rows.get(name);
    if (!row) {
      row = {text: make('span'), note: make('small')};
      row.value = make('dd', {'data-name': name}, row.text, row.note);
      this.list.append(make('div', {}, make('dt', {}, name), row.value));
      this.rows.set(name, row);
    }
    write(row.text, value ?? 'absent');
    write(row.note, note);
    attribute(row.text, 'class', value == null ? 'absent' : grade);
  }
}

const dialog = $('ask');
let answered = Promise.resolve();
// Asks a question in a dialog; true for yes. One after the other: a dialog says later that it was closed, and until then its
// answer must not become that of the next question.
export function ask(text) {
  answered = answered.then(() => new Promise((answer) => {
    $('ask-text').textContent = text;
    dialog.returnValue = 'no';
    dialog.addEventListener('close', () => answer(dialog.returnValue === 'yes'), {once: true});
    dialog.showModal();
  }));
  return answered;
}
