// SPDX-License-Identifier: Apache-2.0
// What stands beside the picture: outcome, tables, plots, texts. Words of a case are set as text, never as HTML.

/** An element with a class, and with texts or other elements inside. */
function make(tag, className, ...children) {
  const element = document.createElement(tag);
  if (className) element.className = className;
  for (const child of children) element.append(child);
  return element;
}

function foldedSection(title, open, ...children) {
  const section = make("details", "", make("summary", "", title), ...children);
  section.open = open;
  return section;
}

/** Rows of cells; the first row is the head. */
function tableWith(rows) {
  const cells = (row, tag) => make("tr", "", ...row.map((cell) =>
    make(tag, typeof cell === "number" ? "number" : "", shown(cell))));
  const shown = (cell) => (typeof cell === "number" ? numberText(cell, 5) : cell === null ? "none" : String(cell));
  const head = rows[0] ? make("thead", "", cells(rows[0], "th")) : "";
  const body = make("tbody", "", ...rows.slice(1).map((row) => cells(row, "td")));
  return make("div", "wide", make("table", "", head, body));
}

/** {a: {b: 1}} as rows ["a b", "1"]. */
function flatRows(value, name) {
  if (value !== null && typeof value === "object" && !Array.isArray(value))
    return Object.entries(value).flatMap(([key, inner]) =>
      flatRows(inner, (name ? name + " " : "") + key.replace(/_/g, " ")));
  return [[name, Array.isArray(value) ? value.join("; ") : value]];
}

const outcomes = {
  completed: "The run completed.",
  failed: "The run failed: its numbers end before the time that was asked for.",
  stopped: "The run was stopped before its end; 'piola resume' continues it.",
  "broken off": "The run broke off without a summary; 'piola resume' continues it.",
  running: "The run has not ended yet: this is what it wrote so far.",
};

function fillHead(about) {
  document.getElementById("title").textContent = about.title;
  const outcome = document.getElementById("outcome");
  outcome.textContent = outcomes[about.status] || about.status;
  outcome.className = about.status;
  const list = document.getElementById("warnings");
  const warnings = (about.summary && about.summary.warnings) || [];
  warnings.forEach((text) => list.append(make("li", "", "Warning: " + text)));
  (about.notes || []).forEach((text) => list.append(make("li", "note", text)));
  if (about.failure)
    document.getElementById("failure").append(make("h2", "", "Why it failed"), make("pre", "", about.failure));
}

const rowHead = ["variant", "quantity", "published", "ours", "difference", "tolerance", "verdict", "evidence", "source",
  "note"];

/** The cells of a row of a verification. */
function rowCells(row) {
  const unit = row.unit === "1" ? "" : " " + row.unit;
  const measured = row.measured === null ? "none" : numberText(row.measured, 5) + unit;
  return [row.variant, row.quantity, numberText(row.reference, 5) + unit, measured, differenceText(row), row.tolerance,
    row.verdict, row.evidence, row.source, row.note];
}

function summaryPanels(about) {
  const panels = [], summary = about.summary;
  if (about.rows.length > 0) {
    panels.push(make("h2", "", "Verification"), tableWith([rowHead, ...about.rows.map(rowCells)]));
  }
  if (!summary) return panels;
  const quantities = Object.entries(summary.quantities || {});
  if (quantities.length > 0)
    panels.push(make("h2", "", "Quantities"), tableWith([["quantity", "value", "unit"],
      ...quantities.map(([name, q]) => [name, q.value, q.unit === "1" ? "" : q.unit])]));
  const { quantities: left, warnings: out, title, ...rest } = summary;
  panels.push(make("h2", "", "Summary"), tableWith([["", ""], ...flatRows(rest, "")]));
  return panels;
}

function differenceText(row) {
  if (row.measured === null) return "";
  const difference = row.measured - row.reference;
  if (row.reference === 0) return numberText(difference, 3);
  return numberText((100 * difference) / Math.abs(row.reference), 3) + " %";
}

/** Plots with a cursor; `moved(time)` is called when one is clicked. Returns what moves all cursors to a time. */
function placePlots(holder, plots, moved) {
  const cursors = plots.map((plot) => {
    const image = make("img"), cursor = make("div", "cursor"), box = make("div", "plot", image, cursor);
    unpacked(bytesOf(plot.svg)).then((svg) => {
      image.src = "data:image/svg+xml," + encodeURIComponent(new TextDecoder().decode(svg));
    });
    image.alt = "Plot of " + plot.name + " over time";
    cursor.style.top = (100 * plot.top) / plot.height + "%";
    cursor.style.height = (100 * (plot.bottom - plot.top)) / plot.height + "%";
    box.addEventListener("click", (event) => {
      const x = (event.offsetX / box.clientWidth) * plot.width;
      moved(plot.low + ((plot.high - plot.low) * (x - plot.left)) / (plot.right - plot.left));
    });
    holder.append(make("h3", "", plot.name), box);
    return (time) => {
      const share = (time - plot.low) / (plot.high - plot.low);
      cursor.hidden = !(share >= -0.001 && share <= 1.001);
      cursor.style.left = (100 * (plot.left + share * (plot.right - plot.left))) / plot.width + "%";
    };
  });
  return (time) => cursors.forEach((cursor) => cursor(time));
}

function fillPlots(about, moved) {
  const holder = document.getElementById("plots"), move = placePlots(holder, about.plots, moved);
  if (about.plots.length === 0) holder.append(make("p", "", "There is no history yet."));
  if (about.plots_left > 0)
    holder.append(make("p", "hint", "history.csv has " + about.plots_left + " more columns; piola plot draws them."));
  return move;
}

function picturesOf(about) {
  return about.pictures.map((picture) => {
    const image = make("img", "picture");
    image.src = "data:image/png;base64," + picture.png;
    image.alt = picture.name;
    return make("figure", "", image, make("figcaption", "", picture.name));
  });
}

function fillTexts(about, pictures) {
  const holder = document.getElementById("texts");
  if (pictures.length > 0) holder.append(foldedSection("Pictures", false, ...pictures));
  if (about.case) holder.append(foldedSection("Case file", false, make("pre", "", about.case)));
  if (about.log) holder.append(foldedSection("Log", false, make("pre", "", about.log)));
}
