// SPDX-License-Identifier: Apache-2.0
// Colours for values, and values as people write them.

/** The colour [r, g, b] at a share from 0 to 1 of a table r g b r g b ... */
function colourIn(table, share) {
  const steps = table.length / 3 - 1, at = Math.min(Math.max(share, 0), 1) * steps;
  const k = Math.min(Math.floor(at), steps - 1), s = at - k;
  return [0, 1, 2].map((c) => Math.round((1 - s) * table[3 * k + c] + s * table[3 * k + 3 + c]));
}

/** The table of a map: those of the pictures, grey, or any of them turned round. */
function tableOf(maps, name) {
  if (name === "grey") return [40, 40, 40, 235, 235, 235];
  return maps[name] || maps.rising;
}

/** The value that a byte of a field stands for; NaN for 0. */
function valueOf(field, code) {
  return code === 0 ? NaN : field.low + ((code - 1) * (field.high - field.low)) / 254;
}

/** 256 colours with alpha, one for each byte of a field, over the range [low, high]. */
function coloursOfCodes(field, table, low, high) {
  const colours = new Uint8Array(256 * 4);
  colours.set([255, 0, 255, 255]);
  for (let code = 1; code < 256; ++code) {
    const share = high > low ? (valueOf(field, code) - low) / (high - low) : 0.5;
    colours.set([...colourIn(table, share), 255], 4 * code);
  }
  return colours;
}

const prefixes = [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "\u00b5"], [1e-9, "n"]];
const prefixed = new Set(["Pa", "m", "s", "J", "N", "W", "Hz", "m/s", "N m", "J/kg"]);

/** {factor, unit}: the unit with the prefix that makes numbers up to `largest` easy to read. */
function shownUnit(largest, unit) {
  if (unit === "1" || !unit) return { factor: 1, unit: "" };
  if (!prefixed.has(unit) || !(largest > 0)) return { factor: 1, unit };
  const found = prefixes.find(([factor]) => largest >= factor) || prefixes[prefixes.length - 1];
  return { factor: found[0], unit: found[1] + unit };
}

/** A number with few digits and a true minus sign. */
function numberText(value, digits = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "none";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text = size >= 1e6 || size < 1e-4 ? value.toExponential(digits - 1).replace(/\.?0+e/, "e").replace("e+", "e")
    : String(Number(value.toPrecision(digits)));
  return text.replace(/-/g, "\u2212");
}

/** "17 MPa" */
function quantityText(value, unit, digits = 4) {
  if (value === null || !Number.isFinite(value)) return "none";
  const shown = shownUnit(Math.abs(value), unit);
  return (numberText(value / shown.factor, digits) + " " + shown.unit).trim();
}

/** The largest of 1, 2, 5 times a power of ten that is not above a length. */
function roundLength(most) {
  const power = Math.pow(10, Math.floor(Math.log10(most)));
  return [5, 2, 1].map((d) => d * power).find((length) => length <= most * (1 + 1e-9));
}

/** Round values between two ends, about `wanted` of them. */
function roundValues(low, high, wanted) {
  const rough = (high - low) / Math.max(wanted, 1), power = Math.pow(10, Math.floor(Math.log10(rough)));
  const step = [1, 2, 5, 10].map((d) => d * power).find((s) => s >= rough * (1 - 1e-9));
  const values = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step && values.length < 50; ++k)
    values.push(k * step);
  return values;
}
