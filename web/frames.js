// SPDX-License-Identifier: Apache-2.0
// From the texts in the page to numbers: the counterpart of src/piola/report/frame_codec.hpp, where the coding is told.

/** The bytes that a base64 text stands for. */
function bytesOf(text) {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = letters.charCodeAt(i);
  return bytes;
}

/** The bytes that were packed (deflate, zlib's format). */
async function unpacked(bytes) {
  const stream = new DecompressionStream("deflate"), writer = stream.writable.getWriter();
  const written = writer.write(bytes).then(() => writer.close());
  const parts = [], reader = stream.readable.getReader();
  let size = 0;
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    parts.push(part.value);
    size += part.value.length;
  }
  await written;
  const whole = new Uint8Array(size);
  size = 0;
  for (const part of parts) {
    whole.set(part, size);
    size += part.length;
  }
  return whole;
}

/** Numbers from their folded differences: `count` low bytes from `at`, then as many high bytes. */
function sumOf(bytes, at, count) {
  const numbers = new Uint16Array(count);
  let sum = 0;
  for (let i = 0; i < count; ++i) {
    const folded = bytes[at + i] | (bytes[at + count + i] << 8);
    sum = (sum + ((folded >> 1) ^ -(folded & 1))) & 0xffff;
    numbers[i] = sum;
  }
  return numbers;
}

/** Numbers below 2^32: all lower halves, then all upper ones. */
function largeNumbersOf(bytes) {
  const count = bytes.length / 4, low = sumOf(bytes, 0, count), high = sumOf(bytes, 2 * count, count);
  return Uint32Array.from(low, (number, i) => number + 65536 * high[i]);
}

/**
 * One frame: x, three arrays of codes, and fields, arrays of bytes. `last` and `before` are the two frames before it,
 * null where there are none since the key frame.
 */
function decodeFrame(bytes, particles, fieldCount, last, before) {
  const frame = { x: [], fields: [] };
  for (let axis = 0; axis < 3; ++axis) {
    const x = sumOf(bytes, 2 * axis * particles, particles);
    if (last && before) {
      const a = last.x[axis], b = before.x[axis];
      for (let i = 0; i < particles; ++i) x[i] += 2 * a[i] - b[i];
    } else if (last) {
      const a = last.x[axis];
      for (let i = 0; i < particles; ++i) x[i] += a[i];
    }
    frame.x.push(x);
  }
  for (let f = 0; f < fieldCount; ++f) {
    const at = (6 + f) * particles, values = new Uint8Array(particles);
    for (let i = 0; i < particles; ++i)
      values[i] = bytes[at + i] + (last ? last.fields[f][i] : i > 0 ? values[i - 1] : 0);
    frame.fields.push(values);
  }
  return frame;
}

/** The frames of a page: unpacked when first wanted; the oldest are forgotten where memory would grow too much. */
class FrameStore {
  /** `about`: the page's element "frames"; `take(name)`: the text of an element, which may be freed afterwards. */
  constructor(about, take) {
    this.about = about;
    this.take = take;
    this.packed = new Map();
    this.known = new Map();
    this.lists = about.fields.length + (about.stretched ? about.stretched.length : 0);
    this.surfaces = new Map();
    const size = about.particles * (6 + this.lists);
    this.most = Math.max(2 * about.key_every, Math.floor(6e8 / Math.max(size, 1)));
    this.queue = Promise.resolve();
  }

  get count() {
    return this.about.times.length;
  }

  /** The decoded frame `k`. One is decoded at a time. */
  get(k) {
    const result = this.queue.then(() => this.decodeTo(k));
    this.queue = result.catch(() => undefined);
    return result;
  }

  async decodeTo(k) {
    const key = k - (k % this.about.key_every), { particles } = this.about;
    const follows = (j) => this.known.has(j - 1) && (j - 1 === key || this.known.has(j - 2));
    let from = k;
    while (from > key && !this.known.has(from) && !follows(from)) --from;
    for (let j = from; j <= k; ++j) {
      if (this.known.has(j)) continue;
      const last = j > key ? this.known.get(j - 1) : null, before = j > key + 1 ? this.known.get(j - 2) : null;
      const bytes = await unpacked(this.bytes(j));
      this.keep(j, decodeFrame(bytes, particles, this.lists, last, before));
    }
    return this.known.get(k);
  }

  /** The corners of the triangles of frame `k`, three places in the list of particles each; null: there are none. */
  facets(k) {
    if (!this.about.facets) return Promise.resolve(null);
    const list = this.about.facets[k];
    if (!this.surfaces.has(list))
      this.surfaces.set(list, unpacked(bytesOf(this.take("facets-" + list))).then(largeNumbersOf));
    return this.surfaces.get(list);
  }

  bytes(k) {
    if (!this.packed.has(k)) this.packed.set(k, bytesOf(this.take("frame-" + k)));
    return this.packed.get(k);
  }

  keep(k, frame) {
    this.known.set(k, frame);
    const group = Math.floor(k / this.about.key_every);
    for (const old of this.known.keys()) {
      if (this.known.size <= this.most) break;
      if (Math.floor(old / this.about.key_every) !== group) this.known.delete(old);
    }
  }
}
