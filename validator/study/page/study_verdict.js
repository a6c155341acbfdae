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

// The effect on the mean over the settings, level by level.
function effectTable(factor) {
  const triplets = factor.triplets_effect, detectors = factor.detectors_effect;
  const cells = (effects, i) => [
    h("td", { class: "number" }, effects.levels[i].mean === null ? "–" : effects.levels[i].mean.toFixed(3)),
    h("td", { class: "number" }, i === factor.base ? "base" : pointsText(effects.changes[i]))];
  return h("div", { class: "scroll" }, h("table", null,
    h("caption", null, `Means over all settings within ${atTolerance}; change against ${factor.labels[factor.base]} in points of 100, with its 95 % interval, paired by ${factor.samples} samples`),
    h("thead", null, h("tr", null, [factor.title, "Matching score", "change", "Repeatability", "change"].map((text, i) =>
      h("th", { scope: "col", class: i > 0 ? "number" : null }, text)))),
    h("tbody", null, levelOrder(study.factors.indexOf(factor)).map((i) => h("tr", null, h("th", { scope: "row" }, factor.labels[i]),
      cells(triplets, i), cells(detectors, i))))));
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
      `${percentText(ranked[0].triplets_effect.explained)} of the variance of the triplets' mean matching score within ${atTolerance}.`));
    target.append(h("div", { class: "scroll" }, h("table", { id: "ranking" },
      h("caption", null, "Factors by the share of the variance that their levels explain (eta squared), each among the samples that differ in it alone"),
      h("thead", null, h("tr", null, ["Factor", "Matching score", "range of means", "Repeatability", "range of means"].map((text, i) =>
        h("th", { scope: "col", class: i > 0 ? "number" : null }, text)))),
      h("tbody", null, ranked.map((factor) => h("tr", null, h("th", { scope: "row" }, factor.title),
        [factor.triplets_effect, factor.detectors_effect].map((one) => [h("td", { class: "number" }, percentText(one.explained)),
          h("td", { class: "number" }, one.range === null ? "–" : one.range.toFixed(3))])))))));
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
