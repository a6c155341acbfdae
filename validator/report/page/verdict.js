// The verdict, the comparison with 2014, and how the report was made.

function drawHeader() {
  const sequences = [...new Set(report.sources.map((source) => source.sequence))].join(", ");
  document.title = `Feature report: ${sequences}`;
  section("title").textContent = `Features on ${sequences}`;
  const lenses = [...new Set(report.cases.map((one) => one.lens))].join(", ");
  const variants = [...new Set(report.sources.map((source) => source.variant))].join(", ");
  const plural = (count, word) => `${count.toLocaleString("en")} ${word}${count === 1 ? "" : "s"}`;
  section("lead").textContent = `${plural(groups.triplets.settings.length, "triplet")} and ` +
    `${plural(groups.detectors.settings.length, "detector")} on ${plural(report.cases.length, "pair")} of ${variants} images` +
    `${lenses ? `, ${lenses} lens` : ""}, judged in 3D at ${plural(tolerances.length, "tolerance")}.`;
}

const VERDICT_MEANING = {
  repeatability: "share of detections seen again", matching_score: "share of detections matched correctly",
  spread_cells: "share of cells of the image circle with a correct match", cpu_s: "detect, describe and match both views",
};

function verdictCell(entry) {
  const cell = h("td", { "data-head": entry.title });
  if (!entry.best) {
    cell.append(h("span", { class: "of" }, "none with matches enough"));
    return cell;
  }
  cell.append(h("span", { class: "value" }, formatValue(entry.metric, entry.best.value)), h("span", null, entry.best.setting));
  if (!entry.enough) cell.append(h("span", { class: "of" }, `of ${Math.round(entry.best.count)} matches only`));
  if (entry.second) {
    cell.append(h("span", { class: "of" }, `then ${formatValue(entry.metric, entry.second.value)} ${entry.second.setting}`));
  }
  return cell;
}

function drawVerdict() {
  const target = section("verdict");
  if (report.verdict.length === 0) {
    target.append(note("The results hold no pair of views, or not the tolerance that the verdict is given at: there is nothing to rank."));
    return;
  }
  const at = `${+(100 * report.verdict_tolerance_m).toPrecision(3)} cm`;
  const entryOf = (metric) => report.verdict[0].entries.find((one) => one.metric === metric);
  const entry = (metric) => entryOf(metric)?.best;
  const best = entry("matching_score"), detector = entry("repeatability");
  const where = report.cases.length > 1 ? "over all pairs" : `on ${report.cases[0].label}`;
  if (best) {
    const few = entryOf("matching_score").enough ? "" : `No triplet has ${report.enough_matches} correct matches within ${at} on each pair. Of those with fewer, `;
    target.append(h("p", { class: "finding" }, few, h("strong", null, best.setting),
      ` matches best ${where}: ${(100 * best.value).toFixed(1)} % of its detections are matched correctly within ${at}.`,
      detector ? ` The most repeatable detector is ${detector.setting} with ${(100 * detector.value).toFixed(1)} %.` : ""));
  } else {
    target.append(h("p", { class: "finding" }, `No triplet has matches enough to go by within ${at} on each pair.`));
  }
  target.append(h("div", { class: "scroll" }, h("table", { class: "stack" },
    h("caption", null, `Best settings within ${at}, of those with at least ${report.enough_matches} (correct) matches where there are such`),
    h("thead", null, h("tr", null, h("th", { scope: "col" }, ""), report.verdict[0].entries.map((one) =>
      h("th", { scope: "col", title: VERDICT_MEANING[one.metric] }, one.title)))),
    h("tbody", null, report.verdict.map((line) => h("tr", null, h("th", { scope: "row" }, line.label), line.entries.map(verdictCell)))))));
  target.append(note(`Repeatability: ${VERDICT_MEANING.repeatability}, of detectors. Matching score: ${VERDICT_MEANING.matching_score}. ` +
    `Spread: ${VERDICT_MEANING.spread_cells}. Speed: CPU time to ${VERDICT_MEANING.cpu_s}; settings that differ in thresholds share ` +
    `these stages, so theirs is an upper bound. Shares are means over the pairs, each pair counting the same.`));
}

const MAX_COMPARED = 12;

// With several results: what the same settings reach in each, by the mean over its pairs.
function drawBetween() {
  if (report.sources.length < 2 || report.verdict.length === 0) return;
  const target = section("verdict"), group = groups.triplets;
  const pairsOf = (source) => report.cases.map((one, i) => i).filter((i) => report.cases[i].source === source);
  const mean = (setting, pairs) => pairs.reduce((sum, i) => sum + group.value("matching_score", setting, i, verdictTolerance), 0) / pairs.length;
  const rows = group.settings.map((setting, i) => ({ name: setting.name, means: report.sources.map((source, j) => mean(i, pairsOf(j))) }))
    .filter((row) => row.means.every((one) => !Number.isNaN(one)));
  rows.sort((a, b) => b.means[0] - a.means[0]);
  target.append(h("h3", null, "Between the results"));
  if (rows.length === 0) {
    target.append(note("They have no triplet in common."));
    return;
  }
  const change = (row, value) => row.means[0] > 0 ? ` (${value >= row.means[0] ? "+" : "−"}${Math.abs(100 * (value / row.means[0] - 1)).toFixed(0)} %)` : "";
  target.append(h("div", { class: "scroll" }, h("table", { id: "between" },
    h("caption", null, `Matching score within ${tolerances[verdictTolerance].label}, mean over the pairs of each; the ${Math.min(rows.length, MAX_COMPARED)} best in ${report.sources[0].name} of ${rows.length} in common`),
    h("thead", null, h("tr", null, h("th", { scope: "col" }, "Setting"), report.sources.map((source) => h("th", { scope: "col", class: "number" }, source.name)))),
    h("tbody", null, rows.slice(0, MAX_COMPARED).map((row) => h("tr", null, h("td", { class: "name" }, row.name),
      row.means.map((value, j) => h("td", { class: "number" }, formatValue("matching_score", value) + (j > 0 ? change(row, value) : "")))))))));
}

const JUDGEMENT_CLASS = { "holds": "holds", "does not hold": "fails", "holds in part": "unsure", "cannot be said": "unsure" };

function drawConclusions(target) {
  const count = (word) => report.conclusions.filter((one) => one.judgement === word).length;
  target.append(h("p", null, `Of ${report.conclusions.length} conclusions of the PFSeq report (Moreau, Ambellouis, Ruichek 2014), ` +
    `${count("holds")} hold here, ${count("holds in part")} in part, ${count("does not hold")} do not; ` +
    `of ${count("cannot be said")} these results cannot tell.`));
  target.append(h("div", { class: "scroll" }, h("table", { class: "stack" },
    h("thead", null, h("tr", null, ["Conclusion of 2014", "Here", "Their figures", "Ours, within 4 cm"].map((text) => h("th", { scope: "col" }, text)))),
    h("tbody", null, report.conclusions.map((one) => h("tr", null,
      h("th", { scope: "row" }, one.claim),
      h("td", { class: `judgement ${JUDGEMENT_CLASS[one.judgement]}` }, one.judgement),
      h("td", { "data-head": "Their figures" }, one.theirs),
      h("td", { "data-head": "Ours" }, one.ours)))))));
}

// Settings that both studies measured, at the verdict's tolerance.
function drawSideBySide(target) {
  target.append(h("h3", null, "The same settings, then and now"));
  if (report.reference.length === 0) {
    target.append(note("The results have no setting and pair (0, 40, 24) in common with the tables of 2014."));
    return;
  }
  const pairs = report.cases.map((one, i) => i).filter((i) => report.reference.some((one) => one.pair === report.cases[i].pair));
  for (const [metric, kind] of [["matching_score", "triplets"], ["repeatability", "detectors"]]) {
    const settings = [...new Set(report.reference.filter((one) => one.metric === metric).map((one) => one.setting))];
    if (settings.length === 0) continue;
    const group = groups[kind];
    target.append(h("div", { class: "scroll" }, h("table", null,
      h("caption", null, `${metricTitle(metric)} within ${tolerances[verdictTolerance].label}: here, and in 2014`),
      h("thead", null,
        h("tr", null, h("th", { rowspan: 2, scope: "col" }, "Setting"), pairs.map((i) => h("th", { colspan: 2, class: "number", scope: "colgroup" }, report.cases[i].label))),
        h("tr", null, pairs.map(() => [h("th", { class: "number", scope: "col" }, "here"), h("th", { class: "number", scope: "col" }, "2014")]))),
      h("tbody", null, settings.map((name) => h("tr", null, h("td", { class: "name" }, name), pairs.map((i) => [
        h("td", { class: "number" }, formatValue(metric, group.value(metric, group.index.get(name), i, verdictTolerance))),
        h("td", { class: "number" }, format2014(metric, value2014(metric, name, i, verdictTolerance)))])))))));
  }
  target.append(note("The 2014 figures are from the report's tables (arXiv 2602.05487), measured on PFSeq itself with its motion blur; " +
    "the images here are others. Curves below can show theirs dashed."));
}

function drawMade() {
  const target = section("made");
  for (const source of report.sources) {
    const facts = [["Sequence", `${source.sequence}, ${source.variant} images`],
      ["Places in the world", source.judge === "map" ? "pixels of the distance map" : "exact rays at the scene"],
      ["Seed of the intervals", String(source.seed)], ["Programs", `pfseq ${source.program}, OpenCV ${source.opencv}`],
      ["Finished", source.finished || "not recorded"], ["Took", source.wall_s ? `${source.wall_s.toFixed(0)} s` : "not recorded"],
      ...(source.credits ? [["Credits of the scene", source.credits]] : [])];
    target.append(h("h3", null, `Results ${source.name}`));
    target.append(source.command ? h("pre", null, source.command) : note("The command was not recorded (no run.json)."));
    target.append(h("div", { class: "scroll" }, h("table", null, h("tbody", null,
      facts.map(([name, value]) => h("tr", null, h("th", { scope: "row" }, name), h("td", null, value)))))));
  }
  target.append(h("h3", null, "This report"), h("pre", null, report.command));
  if (report.files.length > 0) {
    const what = report.has_figures ? "script, SVG, PNG" : "script (gnuplot was missing)";
    target.append(h("details", null, h("summary", null, `${report.files.length} tables (CSV, LaTeX) and figures (${what}) lie beside this page`),
      h("ul", null, report.files.map((file) => h("li", null, `${file.caption}: tables/${file.name}.csv, .tex; `,
        h("code", null, `cd figures && gnuplot ${file.name}.gp`))))));
  } else {
    target.append(note("No setting has enough matches for a table."));
  }
  target.append(note(`Written by pfseq ${report.version}. Charts: Apache ECharts ${echarts.version} (Apache-2.0). Intervals: 95 %, bootstrap over cells of the image circle.`));
}

drawHeader();
drawVerdict();
drawBetween();
drawConclusions(section("study"));
drawSideBySide(section("study"));
drawMade();
