// SPDX-License-Identifier: Apache-2.0
// Drawing with WebGL 2: particles as shaded balls with true depth, rigid shapes as triangles, lines.

// From metres beside the middle of the scene to the screen. `eye` is the distance of the eye from the target, 0 for a
// parallel projection; `deep` the depth of the scene to both sides.
const projection = `
uniform mat3 turn;
uniform vec3 target;
uniform float halfHeight, aspect, deep, eye;
vec4 project(vec3 p) {
  if (eye == 0.0) return vec4(p.x / (halfHeight * aspect), p.y / halfHeight, -p.z / deep, 1.0);
  float near = max(eye - deep, 0.02 * eye), far = eye + deep, z = p.z - eye;
  return vec4(p.x * eye / (halfHeight * aspect), p.y * eye / halfHeight,
              -((far + near) * z + 2.0 * far * near) / (far - near), -z);
}`;

const ballVertex = `#version 300 es
precision highp float;
precision highp int;
${projection}
in vec2 corner;
in float qx, qy, qz, value;
in float body;
uniform vec3 low, cell;
uniform float missing;
uniform highp sampler2D bodies, colours;
uniform vec4 cut;
uniform int marked, asPoints, stretched;
uniform float pixels;
in float s0, s1, s2, s3, s4, s5;
uniform vec4 stretching;
out vec2 place;
out vec3 middle;
out vec3 colour;
out float radius;
out vec2 wide;
flat out mat3 shape;
// V of F = V R makes an ellipsoid of a ball; seen here in the directions of the screen. Its inverse is the shape.
void stretch() {
  vec3 a = stretching.x + (vec3(s0, s1, s2) - 1.0) * stretching.y;
  vec3 b = stretching.z + (vec3(s3, s4, s5) - 1.0) * stretching.w;
  mat3 seen = turn * mat3(a.x, b.x, b.z, b.x, a.y, b.y, b.z, b.y, a.z) * transpose(turn);
  wide = vec2(length(seen[0]), length(seen[1]));
  shape = inverse(seen);
}
void main() {
  wide = vec2(1.0);
  shape = mat3(1.0);
  if (stretched == 1) stretch();
  vec4 kind = texelFetch(bodies, ivec2(int(body), 0), 0);
  vec3 q = vec3(qx, qy, qz), x = low + q * cell;
  bool gone = kind.g < 0.5 || qx == missing || qy == missing || qz == missing || dot(cut.xyz, x) > cut.w;
  colour = texelFetch(colours, ivec2(int(value), 0), 0).rgb;
  radius = max(kind.r, 0.75 / pixels);
  if ((asPoints == 1 ? gl_VertexID : gl_InstanceID) == marked) {
    radius *= 1.6;
    colour = vec3(1.0, 0.1, 0.7);
  }
  place = corner;
  middle = turn * (x - target);
  vec2 aside = asPoints == 1 ? vec2(0.0) : corner * wide * radius;
  float widest = max(wide.x, wide.y);
  gl_PointSize = 2.0 * widest * radius * pixels * (eye == 0.0 ? 1.0 : eye / max(eye - middle.z, 0.02 * eye));
  gl_Position = gone ? vec4(2.0, 2.0, 2.0, 1.0) : project(middle + vec3(aside, 0.0));
}`;

const ballFragment = `#version 300 es
precision highp float;
${projection}
in vec2 place;
in vec3 middle;
in vec3 colour;
in float radius;
in vec2 wide;
flat in mat3 shape;
uniform float flatness;
uniform highp int asPoints;
out vec4 pixel;
void main() {
  vec2 p = asPoints == 1 ? (vec2(2.0, -2.0) * gl_PointCoord + vec2(-1.0, 1.0)) * max(wide.x, wide.y) : place * wide;
  vec3 q = shape * vec3(p, 0.0), deep = shape[2];
  float a = dot(deep, deep), b = dot(deep, q), rest = b * b - a * (dot(q, q) - 1.0);
  if (rest < 0.0) discard;
  float z = (sqrt(rest) - b) / a;
  vec3 n = normalize(shape * (q + z * deep));
  vec4 at = project(middle + vec3(p, z) * radius);
  gl_FragDepth = 0.5 + 0.5 * at.z / at.w;
  float light = max(dot(n, normalize(vec3(-0.35, 0.5, 0.8))), 0.0);
  pixel = vec4(colour * mix(0.38 + 0.66 * light, 1.0, flatness), 1.0);
}`;

const shapeVertex = `#version 300 es
precision highp float;
${projection}
in vec3 point, normal;
uniform mat3 edges;
uniform vec3 centre;
out vec3 side;
out vec3 own;
void main() {
  side = turn * (edges * normal);
  own = point;
  gl_Position = project(turn * (centre + edges * point - target));
}`;

const shapeFragment = `#version 300 es
precision highp float;
in vec3 side;
in vec3 own;
uniform vec4 colour;
uniform float lit, marks;
out vec4 pixel;
void main() {
  float light = lit > 0.5 ? 0.62 + 0.42 * abs(dot(normalize(side), normalize(vec3(-0.35, 0.5, 0.8)))) : 1.0;
  bool dark = marks > 0.5 && own.x * own.y * (marks > 1.5 ? 1.0 : own.z) < 0.0;
  pixel = vec4(colour.rgb * light * (dark ? 0.75 : 1.0), colour.a);
}`;

function programOf(gl, vertex, fragment) {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  const places = {};
  const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS);
  for (let k = 0; k < count; ++k) {
    const name = gl.getActiveUniform(program, k).name;
    places[name] = gl.getUniformLocation(program, name);
  }
  return { program, places };
}

/** A table of colours or numbers, one row, read by number. */
function tableTexture(gl) {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, side, gl.NEAREST);
  for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
  return texture;
}

/** Small balls are points, one vertex each; large ones, for which points have no size, are instances of a square. */
class Balls {
  /** `stretched`: the ends of the bytes of V, by component; null: balls are round. */
  constructor(gl, bodies, stretched) {
    this.gl = gl;
    this.count = bodies.length;
    this.stretched = stretched;
    this.largestPoint = Math.min(gl.getParameter(gl.ALIASED_POINT_SIZE_RANGE)[1] / (stretched ? 4 : 1), 48);
    Object.assign(this, programOf(gl, ballVertex, ballFragment));
    this.buffers = {};
    const stretches = (stretched || []).map((ends, k) => "s" + k);
    for (const name of ["corner", "body", "qx", "qy", "qz", "value", ...stretches])
      this.buffers[name] = gl.createBuffer();
    this.squares = this.arrayWith(1);
    this.points = this.arrayWith(0);
    this.fill("corner", new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]));
    this.fill("body", bodies);
    this.kinds = tableTexture(gl);
    this.colours = tableTexture(gl);
  }

  /** Where the numbers of a particle lie; they belong to `divisor` instances, 0: to a vertex. */
  arrayWith(divisor) {
    const gl = this.gl, array = gl.createVertexArray();
    gl.bindVertexArray(array);
    for (const [name, buffer] of Object.entries(this.buffers)) {
      const place = gl.getAttribLocation(this.program, name), corner = name === "corner";
      if (place < 0 || (corner && divisor === 0)) continue;
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.enableVertexAttribArray(place);
      const small = /^(value|s\d)$/.test(name) ? gl.UNSIGNED_BYTE : gl.UNSIGNED_SHORT, type = corner ? gl.FLOAT : small;
      gl.vertexAttribPointer(place, corner ? 2 : 1, type, false, 0, 0);
      gl.vertexAttribDivisor(place, corner ? 0 : divisor);
    }
    return array;
  }

  fill(name, values) {
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, this.buffers[name]);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, values, this.gl.DYNAMIC_DRAW);
  }

  /** `x`: the codes of the places; `fieldCount`: fields that come before the components of V. */
  setFrame(x, frame, field, fieldCount) {
    ["qx", "qy", "qz"].forEach((name, c) => this.fill(name, x[c]));
    this.fill("value", frame.fields[field] || new Uint8Array(this.count));
    (this.stretched || []).forEach((ends, k) => this.fill("s" + k, frame.fields[fieldCount + k]));
  }

  /** `radii`: of each body, in units of the scene; `shown`: whether it is drawn. */
  setBodies(radii, shown) {
    this.largest = Math.max(...radii, 0);
    const gl = this.gl, values = new Float32Array(4 * radii.length);
    radii.forEach((radius, b) => values.set([radius, shown[b] ? 1 : 0, 0, 0], 4 * b));
    gl.bindTexture(gl.TEXTURE_2D, this.kinds);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, radii.length, 1, 0, gl.RGBA, gl.FLOAT, values);
  }

  setColours(colours) {
    const gl = this.gl;
    gl.bindTexture(gl.TEXTURE_2D, this.colours);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, colours);
  }

  draw(camera, what) {
    const gl = this.gl, at = this.places;
    gl.useProgram(this.program);
    setCamera(gl, at, camera);
    gl.uniform3fv(at.low, what.low);
    gl.uniform3fv(at.cell, what.cell);
    gl.uniform1f(at.missing, what.missing);
    gl.uniform4fv(at.cut, what.cut);
    gl.uniform1i(at.marked, what.marked);
    gl.uniform1f(at.flatness, what.flat ? 1 : 0);
    gl.uniform1i(at.stretched, this.stretched ? 1 : 0);
    if (this.stretched)
      gl.uniform4fv(at.stretching, [0, 3].flatMap((k) => {
        const [low, high] = this.stretched[k];
        return [low, (high - low) / 254];
      }));
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.kinds);
    gl.uniform1i(at.bodies, 0);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, this.colours);
    gl.uniform1i(at.colours, 1);
    gl.activeTexture(gl.TEXTURE0);
    const pixels = camera.pixels, near = camera.eye ? camera.eye / Math.max(camera.eye - 1, 0.05) : 1;
    const asPoints = 2 * 1.6 * this.largest * pixels * near < this.largestPoint;
    gl.uniform1f(at.pixels, pixels);
    gl.uniform1i(at.asPoints, asPoints ? 1 : 0);
    gl.bindVertexArray(asPoints ? this.points : this.squares);
    if (asPoints) gl.drawArrays(gl.POINTS, 0, this.count);
    else gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this.count);
  }
}

function setCamera(gl, at, camera) {
  const { right, up, towards } = camera.axes;
  gl.uniformMatrix3fv(at.turn, false, [0, 1, 2].flatMap((c) => [right[c], up[c], towards[c]]));
  gl.uniform3fv(at.target, camera.target);
  gl.uniform1f(at.halfHeight, camera.halfHeight);
  gl.uniform1f(at.aspect, camera.aspect);
  gl.uniform1f(at.deep, camera.deep);
  gl.uniform1f(at.eye, camera.eye);
}

/** Triangles (point, normal: six numbers each) or lines of a shape about its centre. */
class Shape {
  constructor(gl, tools, numbers, lines) {
    this.gl = gl;
    this.tools = tools;
    this.mode = lines ? gl.LINES : gl.TRIANGLES;
    this.count = numbers.length / 6;
    this.array = gl.createVertexArray();
    gl.bindVertexArray(this.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(numbers), gl.STATIC_DRAW);
    [["point", 0], ["normal", 12]].forEach(([name, offset]) => {
      const place = gl.getAttribLocation(tools.program, name);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 24, offset);
    });
  }

  draw(camera, pose, colour, marks) {
    const gl = this.gl, at = this.tools.places;
    gl.useProgram(this.tools.program);
    setCamera(gl, at, camera);
    gl.uniformMatrix3fv(at.edges, false, pose.edges);
    gl.uniform3fv(at.centre, pose.centre);
    gl.uniform4fv(at.colour, colour);
    gl.uniform1f(at.lit, this.mode === gl.LINES ? 0 : 1);
    gl.uniform1f(at.marks, marks);
    gl.bindVertexArray(this.array);
    gl.drawArrays(this.mode, 0, this.count);
  }
}

/** A box about its centre, by half its edges. */
function boxTriangles(half) {
  const numbers = [];
  for (let axis = 0; axis < 3; ++axis)
    for (const sign of [-1, 1]) {
      const u = (axis + 1) % 3, v = (axis + 2) % 3, normal = [0, 0, 0];
      normal[axis] = sign;
      for (const [s, t] of [[-1, -1], [1, -1], [1, 1], [-1, -1], [1, 1], [-1, 1]]) {
        const p = [0, 0, 0];
        p[axis] = sign * half[axis];
        p[u] = s * half[u];
        p[v] = t * half[v];
        numbers.push(...p, ...normal);
      }
    }
  return numbers;
}

/** The edges of a box, as lines. */
function boxLines(low, high) {
  const numbers = [];
  for (let axis = 0; axis < 3; ++axis)
    for (const s of [0, 1])
      for (const t of [0, 1])
        for (const end of [low, high]) {
          const p = [0, 0, 0];
          p[axis] = end[axis];
          p[(axis + 1) % 3] = (s ? high : low)[(axis + 1) % 3];
          p[(axis + 2) % 3] = (t ? high : low)[(axis + 2) % 3];
          numbers.push(...p, 0, 0, 1);
        }
  return numbers;
}

function sphereTriangles(radius) {
  const across = 48, along = 24, numbers = [];
  const at = (i, j) => {
    const a = (2 * Math.PI * i) / across, b = (Math.PI * j) / along;
    const n = [Math.sin(b) * Math.cos(a), Math.sin(b) * Math.sin(a), Math.cos(b)];
    return [...n.map((x) => radius * x), ...n];
  };
  for (let i = 0; i < across; ++i)
    for (let j = 0; j < along; ++j)
      numbers.push(...at(i, j), ...at(i, j + 1), ...at(i + 1, j + 1),
        ...at(i, j), ...at(i + 1, j + 1), ...at(i + 1, j));
  return numbers;
}

/** A cylinder about its first axis. */
function cylinderTriangles(radius, half) {
  const across = 64, numbers = [];
  for (let i = 0; i < across; ++i) {
    const ring = [i, i + 1].map((k) => [Math.cos((2 * Math.PI * k) / across), Math.sin((2 * Math.PI * k) / across)]);
    const side = (k, x) => [x, radius * ring[k][0], radius * ring[k][1], 0, ...ring[k]];
    numbers.push(...side(0, -half), ...side(1, -half), ...side(1, half),
      ...side(0, -half), ...side(1, half), ...side(0, half));
    for (const x of [-half, half]) {
      const cap = (k) => [x, radius * ring[k][0], radius * ring[k][1], Math.sign(x), 0, 0];
      numbers.push(x, 0, 0, Math.sign(x), 0, 0, ...cap(0), ...cap(1));
    }
  }
  return numbers;
}
