// SPDX-License-Identifier: Apache-2.0
// A minute of a receiver that goes north at 18.5 m/s, and of a compass that states true north.
const line = (body) => `$${body}*${[...body].reduce((sum, c) => sum ^ c.charCodeAt(0), 0).toString(16).toUpperCase().padStart(2, "0")}\r\n`;
for (let s = 0; s < 60; s++) {
  process.stdout.write(line(`GPRMC,1200${String(s).padStart(2, "0")}.00,A,6023.${4000 + 100 * s},N,00519.3270,E,36.0,0.0,010626,,,A`) + line(`HEHDT,${s}.5,T`));
}
