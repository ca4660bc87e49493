// SPDX-License-Identifier: Apache-2.0
// Light and dark: as the system has it, or as chosen here.
import {$, attribute, write} from './dom.js';

const KEY = 'navcal-theme';
const NAMES = {auto: 'Auto', light: 'Light', dark: 'Dark'};
const system = matchMedia('(prefers-color-scheme: dark)');

export function startTheme(onChange) {
  let choice = 'auto';
  try {
    choice = localStorage.getItem(KEY) ?? 'auto';
  } catch {
    // No storage in a frame of another site.
  }
  const apply = () => {
    attribute(document.documentElement, 'data-theme', choice === 'auto' ? (system.matches ? 'dark' : 'light') : choice);
    write($('theme'), NAMES[choice]);
    attribute($('theme'), 'aria-label', `Colours: ${choice === 'auto' ? 'as the system has them' : choice}`);
    onChange();
  };
  system.addEventListener('change', apply);
  $('theme').addEventListener('click', () => {
    const choices = Object.keys(NAMES);
    choice = choices[(choices.indexOf(choice) + 1) % choices.length];
    try {
      localStorage.setItem(KEY, choice);
    } catch {
      // Then it lasts as long as the page.
    }
    apply();
  });
  apply();
}
