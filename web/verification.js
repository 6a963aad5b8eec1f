// SPDX-License-Identifier: Apache-2.0
// The page of a verification: a table of all rows, and a folded section for each run.

const sectionName = (row) => row.case + " (" + row.variant + ")";

/** The section of a run; its plots and pictures are made when it is first opened. */
function runSection(run) {
  const section = foldedSection(sectionName(run) + ": " + run.title, false);
  section.addEventListener("toggle", () => {
    if (!section.open || section.dataset.filled) return;
    section.dataset.filled = "yes";
    if (run.failure) section.append(make("pre", "", run.failure));
    const plots = make("div");
    placePlots(plots, run.plots, () => undefined)(NaN);
    section.append(plots, ...picturesOf(run));
    if (run.summary) section.append(tableWith([["", ""], ...flatRows(run.summary, "")]));
    if (run.text) section.append(foldedSection("Case file", false, make("pre", "", run.text)));
  });
  return section;
}

function fillVerification(about) {
  document.title = byId("title").textContent = about.title;
  const short = about.rows.filter((row) => !row.accepted).length;
  byId("outcome").textContent = (short === 0 ? "All " + about.rows.length + " rows are"
    : short + " of " + about.rows.length + " rows are not") + " as they should be. " + about.evidence;
  byId("outcome").className = short === 0 ? "completed" : "failed";
  byId("left").hidden = true;
  const sections = new Map(about.runs.map((run) => [sectionName(run), runSection(run)]));
  const table = tableWith([["case", ...rowHead], ...about.rows.map((row) => [row.case, ...rowCells(row)])]);
  table.querySelectorAll("tbody tr").forEach((line, k) => {
    const row = about.rows[k], target = sections.get(sectionName(row)), button = make("button", "link", row.case);
    line.className = row.accepted ? "" : "failed";
    button.type = "button";
    button.addEventListener("click", () => {
      target.open = true;
      target.scrollIntoView();
    });
    if (target) line.cells[0].replaceChildren(button);
  });
  byId("tables").append(table, make("h2", "", "Runs"), ...sections.values());
}
