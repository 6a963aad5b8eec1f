// SPDX-License-Identifier: Apache-2.0
// Surfaces of bodies as triangles whose corners are particles; colours are looked up between them.

const surfaceVertex = `#version 300 es
precision highp float;
precision highp int;
${projection}
in vec3 point, normal;
in float value, body;
uniform highp sampler2D bodies;
out vec3 side;
out float code;
void main() {
  side = turn * normal;
  code = value;
  bool gone = texelFetch(bodies, ivec2(int(body), 0), 0).g < 0.5;
  gl_Position = gone ? vec4(2.0, 2.0, 2.0, 1.0) : project(turn * (point - target));
}`;

const surfaceFragment = `#version 300 es
precision highp float;
precision highp int;
in vec3 side;
in float code;
uniform highp sampler2D colours;
uniform float flatness;
out vec4 pixel;
void main() {
  vec3 n = normalize(side);
  float light = max(dot(n.z < 0.0 ? -n : n, normalize(vec3(-0.35, 0.5, 0.8))), 0.0);
  vec3 colour = texelFetch(colours, ivec2(int(code + 0.5), 0), 0).rgb;
  pixel = vec4(colour * mix(0.38 + 0.66 * light, 1.0, flatness), 1.0);
}`;

/** The triangles at each of so many corners: those of corner i are list[begin[i]] to list[begin[i + 1] - 1]. */
function trianglesAround(facets, corners) {
  const begin = new Uint32Array(corners + 1), list = new Uint32Array(facets.length);
  for (const i of facets) ++begin[i + 1];
  for (let i = 0; i < corners; ++i) begin[i + 1] += begin[i];
  const next = begin.slice();
  for (let k = 0; k < facets.length; ++k) list[next[facets[k]]++] = Math.floor(k / 3);
  return { begin, list };
}

/** Normals of triangles: three numbers each, twice as long as the triangle is large, and the lengths. */
function normalsOf(facets, points) {
  const count = facets.length / 3, normal = new Float32Array(3 * count), size = new Float32Array(count);
  for (let f = 0; f < count; ++f) {
    const [a, b, c] = [3 * facets[3 * f], 3 * facets[3 * f + 1], 3 * facets[3 * f + 2]];
    const side = (k, axis) => points[k + axis] - points[a + axis];
    for (let axis = 0; axis < 3; ++axis) {
      const u = (axis + 1) % 3, v = (axis + 2) % 3;
      normal[3 * f + axis] = side(b, u) * side(c, v) - side(b, v) * side(c, u);
    }
    size[f] = Math.hypot(normal[3 * f], normal[3 * f + 1], normal[3 * f + 2]) || 1;
  }
  return { normal, size };
}

/** The normals at corners: the mean of the triangles around, without those beyond an edge of more than 55 degrees. */
function smoothNormals(facets, around, { normal, size }) {
  const smooth = new Float32Array(3 * facets.length), sharp = Math.cos((55 * Math.PI) / 180);
  for (let k = 0; k < facets.length; ++k) {
    const f = Math.floor(k / 3), i = facets[k];
    for (let j = around.begin[i]; j < around.begin[i + 1]; ++j) {
      const g = around.list[j], x = normal[3 * g], y = normal[3 * g + 1], z = normal[3 * g + 2];
      const along = x * normal[3 * f] + y * normal[3 * f + 1] + z * normal[3 * f + 2];
      if (g !== f && !(along > sharp * size[f] * size[g])) continue;
      smooth[3 * k] += x;
      smooth[3 * k + 1] += y;
      smooth[3 * k + 2] += z;
    }
  }
  return smooth;
}

class Surface {
  /** `balls`: whose tables of bodies and colours are used. */
  constructor(gl, balls, bodies) {
    Object.assign(this, { gl, balls, bodies, count: 0 });
    Object.assign(this, programOf(gl, surfaceVertex, surfaceFragment));
    this.buffers = {};
    this.array = gl.createVertexArray();
    gl.bindVertexArray(this.array);
    for (const [name, width, type] of [["point", 3, gl.FLOAT], ["normal", 3, gl.FLOAT],
      ["value", 1, gl.UNSIGNED_BYTE], ["body", 1, gl.UNSIGNED_SHORT]]) {
      const place = gl.getAttribLocation(this.program, name);
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name] = gl.createBuffer());
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, width, type, false, 0, 0);
    }
  }

  fill(name, values) {
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, this.buffers[name]);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, values, this.gl.DYNAMIC_DRAW);
  }

  /** `points`: three numbers per particle, in units of the scene. Returns which particles are in no triangle. */
  setFrame(frame, field, facets, points) {
    if (facets !== this.facets) {
      this.facets = facets;
      this.around = trianglesAround(facets, this.bodies.length);
      this.fill("body", Uint16Array.from(facets, (i) => this.bodies[i]));
    }
    const corners = new Float32Array(3 * facets.length), values = frame.fields[field];
    for (let k = 0; k < facets.length; ++k)
      for (let c = 0; c < 3; ++c) corners[3 * k + c] = points[3 * facets[k] + c];
    this.fill("point", corners);
    this.fill("normal", smoothNormals(facets, this.around, normalsOf(facets, points)));
    this.fill("value", values ? Uint8Array.from(facets, (i) => values[i]) : new Uint8Array(facets.length));
    this.count = facets.length;
    return (i) => this.around.begin[i] === this.around.begin[i + 1];
  }

  draw(camera, flat) {
    const gl = this.gl, at = this.places;
    gl.useProgram(this.program);
    setCamera(gl, at, camera);
    gl.uniform1f(at.flatness, flat ? 1 : 0);
    [["bodies", this.balls.kinds], ["colours", this.balls.colours]].forEach(([name, texture], k) => {
      gl.activeTexture(gl.TEXTURE0 + k);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.uniform1i(at[name], k);
    });
    gl.activeTexture(gl.TEXTURE0);
    gl.bindVertexArray(this.array);
    gl.drawArrays(gl.TRIANGLES, 0, this.count);
  }
}
