// SPDX-License-Identifier: Apache-2.0
// The scene: the frames of the run, rigid shapes and the box of the start, seen through a View.

class Scene {
  /**
   * `about`: the page's element "frames"; bodies: the body of each particle; `numbers`: theirs in the run, null where
   * the page holds each so many. Throws if there is no WebGL 2.
   */
  constructor(canvas, about, bodies, view, numbers) {
    const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
    if (!gl) throw new Error("no WebGL 2");
    Object.assign(this, { canvas, about, gl, view, bodies, numbers });
    this.flat = about.dimension < 3;
    this.setBox(about);
    this.balls = new Balls(gl, bodies, about.stretched);
    this.surface = about.facets ? new Surface(gl, this.balls, bodies) : null;
    this.shown = about.bodies.map(() => true);
    this.tools = programOf(gl, shapeVertex, shapeFragment);
    const [first, last] = about.stage;
    this.stage = [this.mirrored ? [-last[0], first[1], first[2]] : first, last].map((p) => this.inScene(p));
    this.shapes = about.shapes.map((shape) => new Shape(gl, this.tools, this.trianglesOf(shape), false));
    this.outline = new Shape(gl, this.tools, boxLines(...this.stage), true);
    this.showOutline = false;
    this.showShapes = true;
    this.cut = null;  // {axis, place in m, sign}
    this.marked = -1;
    this.dark = false;
    this.setBodies();
  }

  /** The box of all frames. Half sections of axisymmetric bodies (x is the radius) are drawn on both sides. */
  setBox(about) {
    this.mirrored = Boolean(about.mirrored);
    const ends = about.low.map((x, c) => [x, x + about.step[c] * (about.missing - 1)]);
    const radius = Math.max(...ends[0].map(Math.abs));
    if (this.mirrored) ends[0] = [-radius, radius];
    const largest = Math.max(...about.bodies.map((body) => body.radius), 0);
    this.middle = ends.map(([low, high]) => (low + high) / 2);
    this.half = ends.map(([low, high]) => (high - low) / 2);
    this.size = Math.hypot(...this.half.map((x) => 2 * x)) + 2 * largest || 1;
  }

  /** Floats near zero are exact enough: the scene counts from the middle, in units of its size. */
  inScene(p) {
    return p.map((x, c) => (x - this.middle[c]) / this.size);
  }

  trianglesOf(shape) {
    const by = (x) => x / this.size, diagonal = Math.hypot(...this.stage[1].map((x, c) => x - this.stage[0][c]));
    if (shape.kind === "sphere") return sphereTriangles(by(shape.radius));
    if (shape.kind === "cylinder") return cylinderTriangles(by(shape.radius), by(shape.half[0]));
    if (shape.kind === "box") return boxTriangles(shape.half.map(by));
    return boxTriangles([0.01 * diagonal, 0.7 * diagonal, 0.7 * diagonal]);  // a plane: a plate behind its face
  }

  /** Where a shape stands in a frame: columns of its edges, and its centre. */
  poseOf(k, number) {
    const numbers = this.about.poses[k].slice(12 * number, 12 * number + 12), shape = this.about.shapes[number];
    const centre = this.inScene(numbers.slice(0, 3));
    if (shape.kind === "sphere" || shape.kind === "box") return { centre, edges: numbers.slice(3) };
    const n = shape.axis, other = Math.abs(n[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0], side = cross(other, n);
    const a = side.map((x) => x / Math.hypot(...side)), edges = [...n, ...a, ...cross(n, a)];
    if (shape.kind === "cylinder") return { centre, edges };
    const middle = this.stage[0].map((x, c) => (x + this.stage[1][c]) / 2);
    const away = dot(n, middle.map((x, c) => x - centre[c]));
    const thick = 0.01 * Math.hypot(...this.stage[1].map((x, c) => x - this.stage[0][c]));
    return { centre: middle.map((x, c) => x - (away + thick) * n[c]), edges };
  }

  /** The rigid shapes that have an end, where they stand in the first and the last frame: {centre, radius}. */
  endedShapes() {
    const { shapes, poses } = this.about;
    return shapes.flatMap((shape, k) => {
      if (shape.kind === "plane") return [];
      const half = { sphere: [shape.radius], cylinder: [shape.radius, shape.half[0]], box: shape.half }[shape.kind];
      const radius = Math.hypot(...half) / this.size;
      return [poses[0], poses[poses.length - 1]].map((all) =>
        ({ centre: this.inScene(all.slice(12 * k, 12 * k + 3)), radius }));
    });
  }

  /**
   * The zoom with which the box of all frames fills the view as it is turned now, and with it rigid shapes, as far as
   * that leaves the particles half of the view.
   */
  fittingZoom() {
    const { axes } = this.camera(), { width, height } = this.canvas, aspect = width / Math.max(height, 1);
    const radius = Math.max(...this.about.bodies.map((body) => body.radius), 0);
    const half = this.half.map((x) => x / this.size);
    const ends = this.endedShapes();
    const reach = (axis) => {
      const own = half.reduce((sum, h, c) => sum + h * Math.abs(axis[c]), radius / this.size);
      const others = ends.map((shape) => Math.abs(dot(shape.centre, axis)) + shape.radius);
      return Math.max(own, ...others.map((r) => Math.min(r, 2 * own)));
    };
    const needed = Math.max(reach(axes.up), reach(axes.right) / aspect);
    return needed > 0 ? (0.55 * Math.max(1, 1 / aspect)) / (1.12 * needed) : 1;
  }

  setBodies() {
    this.balls.setBodies(this.about.bodies.map((body) => body.radius / this.size), this.shown);
  }

  /** `facets`: triangles of this frame; null: bodies have no surface here. */
  setFrame(k, frame, field, facets) {
    Object.assign(this, { number: k, frame, facets });
    this.balls.setFrame(facets ? this.ballsBeside(frame, field, facets) : frame.x, frame, field,
      this.about.fields.length);
  }

  /** Places of what is not part of a surface; all others are missing, but for the particle that is marked. */
  ballsBeside(frame, field, facets) {
    const { low, step, missing } = this.about, points = new Float32Array(3 * this.bodies.length);
    for (let c = 0; c < 3; ++c) {
      const from = (low[c] - this.middle[c]) / this.size, cell = step[c] / this.size, x = frame.x[c];
      for (let i = 0; i < x.length; ++i) points[3 * i + c] = x[i] === missing ? NaN : from + x[i] * cell;
    }
    const alone = this.surface.setFrame(frame, field, facets, points), first = frame.x[0].slice();
    for (let i = 0; i < first.length; ++i) if (!alone(i) && i !== this.marked) first[i] = missing;
    return [first, frame.x[1], frame.x[2]];
  }

  /** Its number in the run, and the place of a number among the particles of the page: -1 if it is not there. */
  numberOf(i) {
    return this.numbers ? this.numbers[i] : i * this.about.every;
  }
  placeOfNumber(number) {
    if (number < 0) return -1;
    if (this.numbers) return this.numbers.indexOf(number);
    return number % this.about.every === 0 ? number / this.about.every : -1;
  }

  camera() {
    const { width, height } = this.canvas, aspect = width / Math.max(height, 1);
    const halfHeight = (0.55 * Math.max(1, 1 / aspect)) / this.view.zoom;
    return {
      axes: this.view.axes(), pixels: height / (2 * halfHeight), halfHeight, aspect,
      target: this.view.target.map((x) => x / this.size),
      deep: 3 + Math.hypot(...this.view.target) / this.size, eye: this.view.perspective ? 2.5 * halfHeight : 0,
    };
  }

  /** The camera, and for half sections the one that sees their mirror image. */
  cameras(camera) {
    if (!this.mirrored) return [camera];
    const other = ([x, y, z]) => [-x, y, z], { right, up, towards } = camera.axes;
    const axes = { right: other(right), up: other(up), towards: other(towards) };
    return [camera, { ...camera, axes, target: other(camera.target) }];
  }

  draw() {
    const gl = this.gl, camera = this.camera(), cameras = this.cameras(camera);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(...(this.dark ? [0.09, 0.1, 0.12, 1] : [1, 1, 1, 1]));
    gl.enable(gl.DEPTH_TEST);
    gl.depthMask(true);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    if (this.flat) gl.disable(gl.DEPTH_TEST);  // in a plane shapes lie behind all particles
    if (this.showShapes) cameras.forEach((one) => this.drawShapes(one));
    gl.enable(gl.DEPTH_TEST);
    if (this.flat) gl.clear(gl.DEPTH_BUFFER_BIT);
    if (this.frame) cameras.forEach((one) => this.balls.draw(one, this.ballsNow()));
    if (this.frame && this.surface) cameras.forEach((one) => this.surface.draw(one, this.flat));
    const none = { centre: [0, 0, 0], edges: [1, 0, 0, 0, 1, 0, 0, 0, 1] };
    if (this.showOutline) this.outline.draw(camera, none, this.dark ? [0.7, 0.7, 0.7, 1] : [0.3, 0.3, 0.3, 1], 0);
  }

  drawShapes(camera) {
    this.shapes.forEach((shape, k) => {
      const { kind, turns } = this.about.shapes[k], marks = kind === "sphere" && turns ? (this.flat ? 2 : 1) : 0;
      shape.draw(camera, this.poseOf(this.number || 0, k), [0.69, 0.71, 0.74, 1], marks);
    });
  }

  ballsNow() {
    const { low, step, missing } = this.about;
    return {
      low: this.inScene(low), cell: step.map((s) => s / this.size), missing, flat: this.flat, cut: this.cutPlane(),
      marked: this.marked,
    };
  }

  cutPlane() {
    if (!this.cut) return [0, 0, 0, 1];
    const plane = [0, 0, 0, 0], c = "xyz".indexOf(this.cut.axis);
    plane[c] = this.cut.sign;
    plane[3] = this.cut.sign * ((this.cut.place - this.middle[c]) / this.size);
    return plane;
  }

  /** The particle seen at a place of the screen (-1 to 1, upwards), or -1. */
  particleAt(sx, sy) {
    if (!this.frame) return -1;
    const camera = this.camera(), { right, up, towards } = camera.axes, { low, cell, missing, cut } = this.ballsNow();
    const radii = this.about.bodies.map((body) => body.radius / this.size), [x, y, z] = this.frame.x;
    let found = -1, nearest = -Infinity;
    for (let k = 0; k < x.length * (this.mirrored ? 2 : 1); ++k) {
      const i = k % x.length;
      if (x[i] === missing || y[i] === missing || z[i] === missing || !this.shown[this.bodies[i]]) continue;
      const at = [low[0] + x[i] * cell[0], low[1] + y[i] * cell[1], low[2] + z[i] * cell[2]];
      if (dot(cut, at) > cut[3]) continue;
      if (k >= x.length) at[0] = -at[0];
      const p = at.map((v, c) => v - camera.target[c]), depth = dot(p, towards);
      const scale = camera.eye ? camera.eye / Math.max(camera.eye - depth, 1e-9) : 1;
      const dx = sx * camera.halfHeight * camera.aspect - dot(p, right) * scale;
      const dy = sy * camera.halfHeight - dot(p, up) * scale, r = radii[this.bodies[i]] * scale;
      const rest = r * r - dx * dx - dy * dy;
      if (rest >= 0 && depth + Math.sqrt(rest) > nearest) {
        nearest = depth + Math.sqrt(rest);
        found = i;
      }
    }
    return found;
  }

  /** Where a particle is, in digits that the coding holds. */
  placeText(frame, i) {
    const digits = this.about.step.map((s) => Math.min(Math.max(Math.ceil(-Math.log10(s)), 0), 12));
    const texts = this.placeOf(i, frame).map((x, c) => numberText(Number(x.toFixed(digits[c] || 0)), 7));
    return "(" + texts.join(", ") + ") m";
  }

  /** Where a particle is [m]. */
  placeOf(i, frame = this.frame) {
    const { low, step, missing } = this.about;
    return frame.x.map((x, c) => (x[i] === missing ? NaN : low[c] + x[i] * step[c]));
  }
}
