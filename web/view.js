// SPDX-License-Identifier: Apache-2.0
// Where one looks from: azimuth about the axis that points up and elevation, as in pictures.

const axesOf = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const mixed = (s, a, t, b) => [0, 1, 2].map((c) => s * a[c] + t * b[c]);

/** {right, up, towards} at azimuth and elevation 0, where `word` ("y", "-z") points upwards. */
function frameOfUp(word) {
  const negative = word.startsWith("-"), axis = word.replace("-", "");
  const right = { x: [0, -1, 0], y: [1, 0, 0], z: [1, 0, 0] }[axis] || [1, 0, 0];
  const up = axesOf[axis] || axesOf.y;
  const towards = cross(right, up);
  return negative ? { right: mixed(-1, right, 0, up), up: mixed(-1, up, 0, up), towards } : { right, up, towards };
}

class View {
  constructor(upWord, azimuth, elevation) {
    this.base = frameOfUp(upWord);
    this.azimuth = azimuth;      // degrees
    this.elevation = elevation;  // degrees
    this.zoom = 1;
    this.target = [0, 0, 0];     // m, from the middle of the scene
    this.perspective = false;
  }

  /** Unit vectors of the screen: to the right, upwards, towards the viewer. */
  axes() {
    const a = (this.azimuth * Math.PI) / 180, e = (this.elevation * Math.PI) / 180, b = this.base;
    const right = mixed(Math.cos(a), b.right, -Math.sin(a), b.towards);
    const level = mixed(Math.sin(a), b.right, Math.cos(a), b.towards);
    return {
      right,
      up: mixed(Math.cos(e), b.up, -Math.sin(e), level),
      towards: mixed(Math.sin(e), b.up, Math.cos(e), level),
    };
  }

  /** Looks from where an axis ("x", "y", "z") points to, or from between all three ("iso"). */
  lookFrom(word) {
    const from = axesOf[word];
    if (!from) {
      this.azimuth = 45;
      this.elevation = (Math.atan(Math.SQRT1_2) * 180) / Math.PI;
      return;
    }
    this.elevation = (Math.asin(Math.min(Math.max(dot(from, this.base.up), -1), 1)) * 180) / Math.PI;
    const side = dot(from, this.base.right), front = dot(from, this.base.towards);
    this.azimuth = Math.hypot(side, front) > 1e-9 ? (Math.atan2(side, front) * 180) / Math.PI : 0;
  }

  turn(across, down) {
    this.azimuth = (((this.azimuth - across) % 360) + 360) % 360;
    this.elevation = Math.min(Math.max(this.elevation + down, -90), 90);
  }

  /** Moves the target by a part of the screen, in m. */
  move(across, upwards) {
    const { right, up } = this.axes();
    this.target = this.target.map((x, c) => x - across * right[c] - upwards * up[c]);
  }
}
