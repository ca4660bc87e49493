// SPDX-License-Identifier: Apache-2.0
// Numbers as people read them: with unit, and with the standard error where it is known. Null stays null: absent.

export const degrees = (rad) => (rad == null ? null : (rad * 180) / Math.PI);
export const bearing = (deg) => (deg == null ? null : ((deg % 360) + 360) % 360);

// As many decimals as a standard error asks for: two digits of it.
function decimalsFor(std, usual) {
  if (!(std > 0)) return usual;
  return Math.min(usual + 2, Math.max(0, 1 - Math.floor(Math.log10(std))));
}

const thinMinus = (text) => text.replace('-', '\u2212');

export function number(value, unit, usual = 1, std = null) {
  if (value == null || !Number.isFinite(value)) return null;
  const decimals = std == null ? usual : Math.min(decimalsFor(std, usual), usual + 1);
  const space = unit === '\u00b0' || unit === '' ? '' : '\u202f';
  const error = std == null ? '' : ` \u00b1 ${std.toFixed(decimals)}`;
  const text = value.toFixed(decimals);
  return thinMinus(Number(text) === 0 ? text.replace('-', '') : text) + error + space + unit;
}

export function angle(rad, usual = 1, stdRad = null) {
  return number(degrees(rad), '\u00b0', usual, degrees(stdRad));
}

export function duration(seconds) {
  if (seconds == null || !Number.isFinite(seconds)) return null;
  const s = Math.round(seconds);
  if (s < 90) return `${seconds < 10 ? seconds.toFixed(1) : s}\u202fs`;
  if (s < 5400) return `${Math.floor(s / 60)}\u202fmin ${String(s % 60).padStart(2, '0')}\u202fs`;
  if (s < 172800) return `${Math.floor(s / 3600)}\u202fh ${String(Math.floor((s % 3600) / 60)).padStart(2, '0')}\u202fmin`;
  return `${(s / 86400).toFixed(1)}\u202fdays`;
}

export function bytes(count) {
  if (count == null) return null;
  const units = ['B', 'kB', 'MB', 'GB'];
  let i = 0;
  let value = count;
  while (value >= 1000 && i < 3) {
    value /= 1000;
    ++i;
  }
  return `${i === 0 ? value : value.toFixed(value < 10 ? 2 : 1)}\u202f${units[i]}`;
}

export function seconds(value) {
  if (value == null) return null;
  const size = Math.abs(value);
  if (size < 1e-3) return number(value * 1e6, '\u00b5s', 0);
  if (size < 1) return number(value * 1e3, 'ms', 1);
  return number(value, 's', 2);
}

export function clock(utc, withDate = false) {
  if (utc == null) return null;
  const text = new Date(utc * 1000).toISOString();
  return withDate ? text.slice(0, 19).replace('T', ' ') : text.slice(11, 19);
}

// Degrees and decimal minutes, as charts have them.
export function place(value, positive, negative) {
  if (value == null) return null;
  const whole = Math.floor(Math.abs(value));
  const minutes = (Math.abs(value) - whole) * 60;
  return `${whole}\u00b0\u202f${minutes.toFixed(4).padStart(7, '0')}\u2032\u202f${value < 0 ? negative : positive}`;
}

export const words = (name) => String(name ?? '').replaceAll('_', ' ');
