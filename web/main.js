// SPDX-License-Identifier: Apache-2.0
// Reads what the page holds, fills it, and answers to what is done on it.

const byId = (id) => document.getElementById(id);

/** The text of a data element, which is freed. */
function takeText(name) {
  const element = byId("data-" + name), text = element ? element.textContent : "";
  if (element) element.remove();
  return text;
}

/** What is seen stands in the part of the address behind #, so that a page that is loaded again shows the same. */
class Address {
  constructor() {
    this.values = new URLSearchParams(location.hash.slice(1));
  }
  get(name, otherwise) {
    return this.values.has(name) ? this.values.get(name) : otherwise;
  }
  number(name, otherwise) {
    const value = Number(this.get(name, "nothing"));
    return Number.isFinite(value) ? value : otherwise;
  }
  set(values) {
    for (const [name, value] of Object.entries(values))
      if (value === null || value === "") this.values.delete(name);
      else this.values.set(name, String(value));
    clearTimeout(this.timer);
    this.timer = setTimeout(() => history.replaceState(null, "", "#" + this.values), 150);
  }
}

/** Whether values of a field lie below and above a range in any frame. */
function beyondOf(field, low, high) {
  const all = field.extremes.filter((ends) => ends[0] !== null);
  return [all.some((ends) => ends[0] < low), all.some((ends) => ends[1] > high)];
}

class Page {
  constructor(about, frames, scene, store, address) {
    Object.assign(this, { about, frames, scene, store, address });
    this.wanted = -1;
    this.field = 0;
    this.playing = null;
    this.range = [0, 1];
  }

  get fieldNow() {
    return this.frames.fields[this.field];
  }

  /** Shows a frame; of those that are asked for while one is unpacked only the last one counts. */
  async show(k) {
    k = Math.min(Math.max(Math.round(k), 0), this.store.count - 1);
    if (this.wanted === k) return;
    this.wanted = k;
    const [frame, facets] = await Promise.all([this.store.get(k), this.store.facets(k)]);
    if (this.wanted !== k) return;
    this.scene.setFrame(k, frame, this.field, facets);
    byId("time").value = k;
    const time = this.frames.times[k];
    byId("clock").textContent = quantityText(time, "s") + "  (frame " + this.frames.numbers[k] + ")";
    this.moveCursors(time);
    this.address.set({ frame: k === this.store.count - 1 && this.about.status === "running" ? "last" : k });
    this.recolour();
    this.tellParticle();
    byId("view").setAttribute("aria-label", "Particles at " + quantityText(time, "s") + ", coloured by " +
      (this.fieldNow ? this.fieldNow.label : "nothing"));
    document.documentElement.dataset.frame = k;
  }

  showTime(time) {
    const distance = this.frames.times.map((t) => Math.abs(t - time));
    this.stop();
    this.show(distance.indexOf(Math.min(...distance)));
  }

  /** The range that is asked for, and the colours over it. */
  recolour() {
    const field = this.fieldNow;
    if (!field) return this.draw();
    const kind = byId("range").value;
    let [low, high] = [field.low, field.high];
    if (kind === "frame" && field.extremes[this.wanted] && field.extremes[this.wanted][0] !== null)
      [low, high] = field.extremes[this.wanted];
    if (kind === "typed") {
      const number = (id) => Number(byId(id).value.replace("\u2212", "-").replace(",", ".")) * this.typedUnit.factor;
      const typed = [number("low"), number("high")];
      if (typed.every(Number.isFinite) && typed[0] < typed[1]) [low, high] = typed;
    }
    const chosen = byId("map").value, around = low < 0 && high > 0 && Math.min(-low, high) > 0.1 * Math.max(-low, high);
    const name = chosen === "auto" ? (around ? "around zero" : "rising") : chosen;
    if (name === "around zero") {
      high = Math.max(-low, high);
      low = -high;
    }
    this.range = [low, high];
    this.table = tableOf(this.frames.maps, name);
    this.scene.balls.setColours(coloursOfCodes(field, this.table, low, high));
    this.drawLegend();
    const ends = field.extremes[this.wanted];
    byId("extremes").textContent = ends && ends[0] !== null
      ? "in this frame from " + quantityText(ends[0], field.unit) + " to " + quantityText(ends[1], field.unit) : "";
    this.draw();
  }

  chooseField(number) {
    this.field = Math.min(Math.max(number, 0), Math.max(this.frames.fields.length - 1, 0));
    byId("field").selectedIndex = this.field;
    const field = this.fieldNow;
    if (!field) return;
    this.typedUnit = shownUnit(Math.max(Math.abs(field.low), Math.abs(field.high)), field.unit);
    byId("typed-unit").textContent = this.typedUnit.unit;
    this.setAgain();
  }

  setAgain() {
    const { scene } = this;
    if (scene.frame) scene.setFrame(scene.number, scene.frame, this.field, scene.facets);
  }

  draw() {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      this.resize();
      this.scene.draw();
      drawMarks(byId("marks"), this.scene);
    });
  }

  resize() {
    const box = byId("box"), scale = Math.min(window.devicePixelRatio || 1, 2);
    for (const id of ["view", "marks"]) {
      const canvas = byId(id), [width, height] = [box.clientWidth, box.clientHeight].map((x) => Math.round(x * scale));
      if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    }
  }

  drawLegend() {
    const field = this.fieldNow, [low, high] = this.range;
    drawBar(byId("bar"), { field, low, high, table: this.table, beyond: beyondOf(field, low, high) });
  }

  play() {
    if (this.playing) return this.stop();
    byId("play").textContent = "\u23f8";
    const step = async () => {
      await this.show(this.wanted + 1 >= this.store.count ? 0 : this.wanted + 1);
      if (this.playing) this.playing = setTimeout(step, 1000 / Number(byId("speed").value));
    };
    this.playing = setTimeout(step, 0);
  }

  stop() {
    clearTimeout(this.playing);
    this.playing = null;
    byId("play").textContent = "\u25b6";
  }

  async mark(particle) {
    this.scene.marked = particle;
    if (this.scene.surface) this.setAgain();
    if (particle >= 0 && !this.first && this.frames.times[0] === 0) this.first = await this.store.get(0);
    this.tellParticle();
    this.draw();
  }

  tellParticle() {
    const box = byId("particle"), i = this.scene.marked;
    box.hidden = i < 0 || !this.scene.frame;
    if (box.hidden) return;
    const body = this.frames.bodies[this.scene.bodies[i]].name;
    const lines = ["particle " + this.scene.numberOf(i) + " of " + body,
      "x = " + this.scene.placeText(this.scene.frame, i)];
    if (this.first) lines.splice(1, 0, "at the start " + this.scene.placeText(this.first, i));
    this.frames.fields.forEach((field, f) => {
      const code = this.scene.frame.fields[f][i], [under, over] = beyondOf(field, field.low, field.high);
      const sign = code === 1 && under ? "\u2264 " : code === 255 && over ? "\u2265 " : "";
      lines.push(field.label + ": " + sign + quantityText(valueOf(field, code), field.unit, 3));
    });
    box.replaceChildren(...lines.map((line) => make("div", "", line)));
  }

  setCut() {
    const axis = byId("cut").value, c = axis ? "xyz".indexOf(axis) : -1, { low, step, missing } = this.frames;
    const share = Number(byId("cut-place").value) / 1000;
    const place = c < 0 ? 0 : low[c] + share * step[c] * (missing - 1);
    this.scene.cut = c < 0 ? null : { axis, place, sign: byId("cut-side").checked ? -1 : 1 };
    document.querySelectorAll(".cutting").forEach((part) => { part.hidden = c < 0; });
    byId("cut-text").textContent = c < 0 ? "" : axis + " = " + quantityText(place, "m");
    this.address.set({ cut: c < 0 ? null : axis, at: c < 0 ? null : share, side: byId("cut-side").checked ? 1 : null });
    this.draw();
  }

  keepView() {
    const { azimuth, elevation, zoom, target, perspective } = this.scene.view;
    this.address.set({
      a: azimuth.toFixed(1), e: elevation.toFixed(1), zoom: zoom.toPrecision(4),
      to: target.map((x) => x.toPrecision(4)).join("_"), persp: perspective ? 1 : 0,
    });
    this.draw();
  }
}

/** The bar of colours with round values below it; triangles at the ends where values lie beyond. */
function drawBar(canvas, what) {
  const scale = Math.min(window.devicePixelRatio || 1, 2), width = canvas.clientWidth, { low, high, field } = what;
  canvas.width = width * scale;
  canvas.height = 54 * scale;
  const pen = canvas.getContext("2d"), left = 24, right = width - 24, colour = getComputedStyle(document.body).color;
  pen.scale(scale, scale);
  for (let x = left; x < right; ++x) {
    pen.fillStyle = "rgb(" + colourIn(what.table, (x - left) / (right - left)) + ")";
    pen.fillRect(x, 20, 1.5, 14);
  }
  [[left - 2, -12, 0], [right + 2, 12, 1]].forEach(([x, tip, end]) => {
    if (!what.beyond[end]) return;
    pen.fillStyle = "rgb(" + colourIn(what.table, end) + ")";
    pen.beginPath();
    pen.moveTo(x, 20);
    pen.lineTo(x, 34);
    pen.lineTo(x + tip, 27);
    pen.fill();
  });
  const shown = shownUnit(Math.max(Math.abs(low), Math.abs(high)), field.unit);
  pen.fillStyle = colour;
  pen.font = "13px DejaVu Sans, sans-serif";
  pen.textAlign = "left";
  pen.fillText(field.label + (shown.unit ? " [" + shown.unit + "]" : ""), left, 14);
  pen.textAlign = "center";
  const values = high > low ? roundValues(low / shown.factor, high / shown.factor, 6) : [low / shown.factor];
  for (const value of values) {
    const share = high > low ? (value * shown.factor - low) / (high - low) : 0.5;
    pen.fillText(numberText(Number(value.toPrecision(10))), left + share * (right - left), 49);
  }
}

/** Axes in the corner and, in a parallel projection, the length of a bar. */
function drawMarks(canvas, scene) {
  const pen = canvas.getContext("2d"), scale = Math.min(window.devicePixelRatio || 1, 2), camera = scene.camera();
  const { right, up, towards } = camera.axes, width = canvas.width / scale, height = canvas.height / scale;
  pen.setTransform(scale, 0, 0, scale, 0, 0);
  pen.clearRect(0, 0, width, height);
  pen.font = "13px DejaVu Sans, sans-serif";
  pen.textAlign = "center";
  pen.lineWidth = 2;
  const axes = ["x", "y", "z"].map((name, c) => ({ name, at: [right[c], up[c], towards[c]] }));
  axes.sort((a, b) => a.at[2] - b.at[2]);
  const colours = scene.dark ? { x: "#ff8a80", y: "#8fd694", z: "#82b1ff" }
    : { x: "#c62828", y: "#2e7d32", z: "#1f4fb5" };
  for (const { name, at } of axes) {
    if (scene.flat && name === "z") continue;
    pen.strokeStyle = pen.fillStyle = colours[name];
    pen.beginPath();
    pen.moveTo(48, height - 48);
    pen.lineTo(48 + 30 * at[0], height - 48 - 30 * at[1]);
    pen.stroke();
    pen.fillText(name, 48 + 40 * at[0], height - 44 - 40 * at[1]);
  }
  if (camera.eye !== 0 || height < 10) return;
  const metre = height / (2 * camera.halfHeight * scene.size), length = roundLength(120 / metre);
  pen.strokeStyle = pen.fillStyle = scene.dark ? "#e4e7eb" : "#1b1d21";
  pen.fillRect(width - 20 - length * metre, height - 22, length * metre, 2);
  pen.fillText(quantityText(length, "m"), width - 20 - (length * metre) / 2, height - 28);
}

function bindControls(page) {
  const { scene, address } = page, view = scene.view;
  const on = (id, event, action) => byId(id).addEventListener(event, action);
  on("time", "input", () => { page.stop(); page.show(Number(byId("time").value)); });
  on("play", "click", () => page.play());
  on("field", "change", () => {
    page.chooseField(byId("field").selectedIndex);
    address.set({ field: page.fieldNow.name });
    page.recolour();
  });
  on("map", "change", () => { address.set({ map: byId("map").value }); page.recolour(); });
  const ranged = () => {
    const typed = byId("range").value === "typed";
    document.querySelectorAll(".typed").forEach((label) => { label.hidden = !typed; });
    const end = (id) => (typed ? byId(id).value : null);
    address.set({ range: byId("range").value, low: end("low"), high: end("high") });
    page.recolour();
  };
  on("range", "change", () => {
    if (byId("range").value === "typed" && !byId("low").value)
      ["low", "high"].forEach((id, k) => {
        byId(id).value = Number((page.range[k] / page.typedUnit.factor).toPrecision(4));
      });
    ranged();
  });
  ["low", "high"].forEach((id) => on(id, "change", ranged));
  document.querySelectorAll("[data-look]").forEach((button) => button.addEventListener("click", () => {
    view.lookFrom(button.dataset.look);
    page.keepView();
  }));
  on("perspective", "change", () => { view.perspective = byId("perspective").checked; page.keepView(); });
  on("outline", "change", () => { scene.showOutline = byId("outline").checked; page.draw(); });
  on("shapes", "change", () => { scene.showShapes = byId("shapes").checked; page.draw(); });
  on("reset", "click", () => {
    Object.assign(view, { ...page.home, target: [0, 0, 0] });
    page.mark(-1);
    page.keepView();
  });
  for (const id of ["cut", "cut-side"]) on(id, "change", () => page.setCut());
  on("cut-place", "input", () => page.setCut());
  new ResizeObserver(() => { page.draw(); if (page.table) page.drawLegend(); }).observe(byId("box"));
  const darkness = window.matchMedia("(prefers-color-scheme: dark)");
  const adapt = () => { scene.dark = darkness.matches; page.draw(); if (page.table) page.drawLegend(); };
  darkness.addEventListener("change", adapt);
  adapt();
}

/** Mouse, pen and fingers on the picture, and keys everywhere. */
function bindPointer(page) {
  const canvas = byId("view"), { scene } = page, { view } = scene, held = new Map();
  const metres = () => (2 * scene.camera().halfHeight * scene.size) / Math.max(canvas.clientHeight, 1);
  const placeOn = ({ offsetX, offsetY }) =>
    [(2 * offsetX) / canvas.clientWidth - 1, 1 - (2 * offsetY) / canvas.clientHeight];
  let travelled = 0;
  canvas.addEventListener("pointerdown", (event) => {
    held.set(event.pointerId, event);
    travelled = 0;
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = held.get(event.pointerId);
    if (!before) return;
    const dx = event.clientX - before.clientX, dy = event.clientY - before.clientY;
    travelled += Math.abs(dx) + Math.abs(dy);
    if (held.size === 2) {
      const other = [...held.entries()].find(([id]) => id !== event.pointerId)[1];
      const apart = (e) => Math.hypot(e.clientX - other.clientX, e.clientY - other.clientY);
      view.zoom = Math.min(Math.max((view.zoom * apart(event)) / Math.max(apart(before), 1), 0.05), 500);
    } else if (event.shiftKey || before.button === 2 || scene.flat) {
      view.move(dx * metres(), -dy * metres());
    } else {
      view.turn(0.4 * dx, 0.4 * dy);
    }
    held.set(event.pointerId, { clientX: event.clientX, clientY: event.clientY, button: before.button });
    page.keepView();
  });
  canvas.addEventListener("pointerup", (event) => {
    held.delete(event.pointerId);
    if (travelled < 4 && event.button === 0) page.mark(scene.particleAt(...placeOn(event)));
  });
  canvas.addEventListener("pointercancel", (event) => held.delete(event.pointerId));
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    view.zoom = Math.min(Math.max(view.zoom * Math.exp(-0.0015 * event.deltaY), 0.05), 500);
    page.keepView();
  }, { passive: false });
  canvas.addEventListener("dblclick", (event) => {
    const found = scene.particleAt(...placeOn(event));
    if (found < 0) return;
    view.target = scene.placeOf(found).map((x, c) => x - scene.middle[c]);
    page.keepView();
  });
  document.addEventListener("keydown", (event) => {
    if (/^(INPUT|SELECT|TEXTAREA|BUTTON|SUMMARY)$/.test(event.target.tagName)) return;
    const step = { ArrowRight: 1, ArrowLeft: -1, PageDown: 10, PageUp: -10 }[event.key];
    const closer = { "+": 1.2, "-": 1 / 1.2 }[event.key];
    if (step) page.stop(), page.show(page.wanted + step);
    else if (closer) (view.zoom *= closer), page.keepView();
    else if (event.key === "Home") page.show(0);
    else if (event.key === "End") page.show(page.store.count - 1);
    else if (event.key === " ") page.play();
    else if (event.key === "Escape") page.mark(-1);
    else return;
    event.preventDefault();
  });
}

function fillControls(page) {
  const { frames, scene, address } = page;
  frames.fields.forEach((field) => byId("field").append(make("option", "", field.label)));
  byId("time").max = page.store.count - 1;
  byId("shapes-label").hidden = frames.shapes.length === 0;
  byId("cut-row").hidden = Boolean(frames.facets);  // nothing lies inside
  const hidden = new Set(address.get("off", "").split("_").filter(Boolean).map(Number));
  frames.bodies.forEach((body, b) => {
    const box = make("input");
    box.type = "checkbox";
    scene.shown[b] = box.checked = !hidden.has(b);
    box.addEventListener("change", () => {
      scene.shown[b] = box.checked;
      scene.setBodies();
      address.set({ off: scene.shown.flatMap((on, k) => (on ? [] : [k])).join("_") });
      page.draw();
    });
    byId("bodies").append(make("label", "", box, " " + body.name));
  });
  scene.setBodies();
  byId("bodies").hidden = frames.bodies.length < 2;
}

/** What the address says about view, colours and cut. */
function restore(page) {
  const { address, scene } = page, { view } = scene;
  page.resize();
  page.home = { azimuth: view.azimuth, elevation: view.elevation, zoom: scene.fittingZoom() };
  view.azimuth = address.number("a", view.azimuth);
  view.elevation = address.number("e", view.elevation);
  view.zoom = Math.min(Math.max(address.number("zoom", page.home.zoom), 0.05), 500);
  const target = address.get("to", "").split("_").map(Number);
  if (target.length === 3 && target.every(Number.isFinite)) view.target = target;
  byId("perspective").checked = view.perspective = address.get("persp", view.perspective ? "1" : "0") === "1";
  const cutting = page.frames.facets ? [] : ["cut"];
  for (const id of ["map", "range", "low", "high", ...cutting]) if (address.get(id)) byId(id).value = address.get(id);
  document.querySelectorAll(".typed").forEach((label) => { label.hidden = byId("range").value !== "typed"; });
  byId("cut-place").value = 1000 * address.number("at", 0.5);
  byId("cut-side").checked = address.get("side") === "1";
  const named = page.frames.fields.findIndex((field) => field.name === address.get("field"));
  page.chooseField(Math.max(named, 0));
  page.setCut();
}

/** Makes the scene; without WebGL 2 the page says so, and plots, tables and pictures remain. */
async function openScene(about, address) {
  const text = takeText("frames");
  if (!text) throw new Error("This run has no frames to show.");
  const frames = JSON.parse(text);
  const bodies = sumOf(await unpacked(bytesOf(takeText("bodies"))), 0, frames.particles);
  const plane = frames.dimension < 3;
  const numbers = frames.facets ? largeNumbersOf(await unpacked(bytesOf(takeText("particles")))) : null;
  const view = new View(plane ? "y" : about.up, plane ? 0 : about.view[0], plane ? 0 : about.view[1]);
  view.perspective = !plane && Boolean(about.perspective);
  let scene;
  try {
    scene = new Scene(byId("view"), frames, bodies, view, numbers);
  } catch (error) {
    throw new Error("Particles cannot be drawn here (" + error.message + "); plots, tables and pictures remain.");
  }
  return new Page(about, frames, scene, new FrameStore(frames, takeText), address);
}

function follow(about) {
  if (!about.reload) return;
  byId("follow-label").hidden = false;
  setInterval(() => { if (byId("follow").checked && !document.hidden) location.reload(); }, 1000 * about.reload);
}

async function start() {
  const about = JSON.parse(takeText("about")), address = new Address();
  byId("made").textContent = "Written by Piola " + about.version + ".";
  if (about.kind === "verification") {
    fillVerification(about);
    document.documentElement.dataset.ready = "yes";
    return;
  }
  fillHead(about);
  byId("tables").append(...summaryPanels(about));
  follow(about);
  let page = null;
  const moveCursors = fillPlots(about, (time) => page && page.showTime(time));
  try {
    page = await openScene(about, address);
  } catch (error) {
    byId("scene").hidden = true;
    byId("no-view").hidden = false;
    byId("no-view").textContent = error.message;
    byId("left").append(...picturesOf(about));
    fillTexts(about, []);
    moveCursors(NaN);
    document.documentElement.dataset.ready = "without view";
    return;
  }
  fillTexts(about, picturesOf(about));
  page.moveCursors = moveCursors;
  fillControls(page);
  restore(page);
  bindControls(page);
  bindPointer(page);
  page.scene.marked = page.scene.placeOfNumber(about.failed_particle);
  const asked = address.get("frame", about.status === "running" || about.status === "failed" ? "last" : "0");
  await page.show(asked === "last" ? page.store.count - 1 : Number(asked) || 0);
  document.documentElement.dataset.ready = "yes";
}

start();
