// The verdict: what the factors do, and which settings overtake others.

const atTolerance = tolerances[verdictTolerance]?.label ?? "";

function drawHeader() {
  document.title = `Study: ${study.name}`;
  section("title").textContent = study.name;
  const plural = (count, word) => `${count.toLocaleString("en")} ${word}${count === 1 ? "" : "s"}`;
  section("lead").textContent = `${plural(study.variants.length, "variant")} of a sequence (${study.factors.map((one) => one.title).join("; ")}` +
    `${study.factors.length > 1 ? `, ${study.design}` : ""}; ${plural(study.repetitions, "repetition")}), ` +
    `${plural(study.triplets.length, "triplet")} and ${plural(study.detectors.length, "detector")} on ${study.images} images, judged in 3D.`;
}

// On a phone the rows become blocks, each cell below its heading.
function verdictTable(id, caption, headings, rows) {
  return h("div", { class: "scroll" }, h("table", { class: "stack", id },
    h("caption", null, caption),
    h("thead", null, h("tr", null, headings.map((text, i) => h("th", { scope: "col", class: i > 0 ? "number" : null }, text)))),
    h("tbody", null, rows.map(([name, ...cells]) => h("tr", null, h("th", { scope: "row" }, name),
      cells.map((text, i) => h("td", { class: "number", "data-head": headings[i + 1] }, text)))))));
}

// The effect on the mean over the settings, level by level.
function effectTable(factor) {
  const cells = (effects, i, mean, change) => [effects.levels[i].mean === null ? "–" : mean(effects.levels[i].mean),
    i === factor.base ? "base" : change(effects.changes[i])];
  const share = (value) => value.toFixed(3), count = (value) => Math.round(value).toLocaleString("en");
  return verdictTable(null,
    `Means over all settings within ${atTolerance}; change against ${factor.labels[factor.base]} (shares in points of 100) with its 95 % interval, paired by ${factor.samples} samples`,
    [factor.title, "Matching score", "its change", "Repeatability", "its change", "Detections", "its change"],
    levelOrder(study.factors.indexOf(factor)).map((i) => [factor.labels[i], ...cells(factor.triplets_effect, i, share, pointsText),
      ...cells(factor.detectors_effect, i, share, pointsText), ...cells(factor.detections_effect, i, count, countText)]));
}

function drawVerdict() {
  const target = section("verdict");
  study.remarks.forEach((remark) => target.append(note(remark)));
  const ranked = study.ranking.map((i) => study.factors[i]);
  if (ranked.every((factor) => factor.samples === 0)) {
    target.append(note("No pair of views was measured at all levels of a factor: there is nothing to compare."));
    return;
  }
  if (ranked.length > 1) {
    target.append(h("p", { class: "finding" }, h("strong", null, ranked[0].title), ` matters most: its levels explain ` +
      `${percentText(ranked[0].triplets_effect.explained)} of the variance of the triplets' mean matching score within ${atTolerance}` +
      (ranked[0].triplets_effect.changes.some((one) => (one.low !== null && one.low > 0) || (one.high !== null && one.high < 0)) ? "." :
        ", though no change against its base can be told from none.")));
    target.append(verdictTable("ranking",
      "Factors by the share of the variance that their levels explain (eta squared), each among the samples that differ in it alone",
      ["Factor", "Matching score", "range of its means", "Repeatability", "range of its means"],
      ranked.map((factor) => [factor.title, ...[factor.triplets_effect, factor.detectors_effect].flatMap((one) =>
        [percentText(one.explained), one.range === null ? "–" : one.range.toFixed(3)])])));
  }
  ranked.forEach((factor, i) => {
    target.append(h("p", { class: ranked.length === 1 ? "finding" : null }, factor.text));
    const leading = factor.comparisons.slice(0, 2);
    if (i === 0) leading.forEach((one) => target.append(h("p", { class: "finding" }, one.text)));
    target.append(effectTable(factor));
  });
  target.append(note("Intervals: 95 %, Student's t over samples (a sample is a pair of views in a repetition). Pairs of one repetition show the same city, " +
    "so they are not quite independent; intervals are not corrected for the number of comparisons."));
}

function drawOvertaking() {
  const target = section("overtaking");
  const all = study.factors.flatMap((factor, i) => factor.comparisons.map((one) => ({ ...one, factor: i })));
  if (all.length === 0) {
    target.append(note("The study compares no settings (compare), and there are not two of different detector or descriptor with matches."));
    return;
  }
  target.append(h("p", null, `Differences of matching scores (of detectors: repeatability) within ${atTolerance} on the same pairs, in points of 100. ` +
    "A setting is called ahead where the 95 % interval of the paired difference leaves out 0."));
  study.factors.forEach((factor, i) => {
    const own = all.filter((one) => one.factor === i);
    if (own.length === 0) return;
    if (study.factors.length > 1) target.append(h("h3", null, factor.title));
    target.append(h("ul", { class: "sentences" }, own.map((one) => h("li", null, one.text))));
    const order = levelOrder(i);
    const state = { chosen: 0 };
    const element = h("div", { class: "chart", role: "img" });
    let redraw = () => {};
    if (own.length > 1) {
      target.append(h("div", { class: "controls" }, choice("Comparison", own.map((one, j) =>
        [j, `${one.short_a} − ${one.short_b}${one.shared ? `, ${one.shared}` : ""}`]), 0, (value) => { state.chosen = Number(value); redraw(); })));
    }
    target.append(element);
    redraw = makeChart(element, (chart) => {
      const one = own[state.chosen];
      element.setAttribute("aria-label", one.text);
      drawOverLevels(chart, i, [{
        name: `${one.short_a} − ${one.short_b}`, color: 0,
        at: (level) => { const d = one.differences[level]; return [d.mean, d.low, d.high].map((v) => (v === null ? NaN : 100 * v)); },
      }], { title: "Difference, points of 100", format: (value) => value.toFixed(1), order });
    });
  });
}

drawHeader();
