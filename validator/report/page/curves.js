// Curves over the tolerance: any metric, pair and choice of settings.

const MAX_CURVES = 8;
const MAX_SUGGESTIONS = 8;

function drawCurves() {
  const target = section("curves");
  const measures = ["triplets", "detectors"].map((kind) => ({
    group: kind === "triplets" ? "Triplets" : "Detectors",
    options: groups[kind].names().filter((name) => groups[kind].hasTolerance(name)).map((name) => [`${kind} ${name}`, metricTitle(name)]),
  })).filter((one) => one.options.length > 0);
  if (measures.length === 0 || report.cases.length === 0) {
    target.append(note("The results hold no metric over tolerances."));
    return;
  }
  const first = measures[0].options.map(([value]) => value);
  const state = {
    measure: ["triplets matching_score", "detectors repeatability"].find((value) => first.includes(value)) ?? first[0],
    pair: report.cases.length > 1 ? MEAN : 0, unit: "cm", intervals: false, with2014: false, curves: [],
  };
  const kind = () => state.measure.split(" ")[0];
  const metric = () => state.measure.split(" ")[1];
  const group = () => groups[kind()];
  const places = () => tolerances.map((one, i) => i).filter((i) => tolerances[i].unit === state.unit);

  const value = (curve, place) => group().value(metric(), curve.setting, state.pair, place);
  const limits = (curve, place) => [`${metric()}_low`, `${metric()}_high`].map((name) => group().value(name, curve.setting, state.pair, place));

  function choose(settings) {
    state.curves = settings.slice(0, MAX_CURVES).map((setting, color) => ({ setting, color, hidden: false }));
  }
  function chooseBest() {
    const counts = kind() === "triplets" ? "correct_matches" : "matches";
    const last = report.tolerances_m.length - 1;
    const ranked = (settings) => settings.map((i) => [i, group().value(metric(), i, state.pair, verdictTolerance)])
      .filter(([, value]) => !Number.isNaN(value)).sort((a, b) => b[1] - a[1]).map(([i]) => i);
    const all = group().settings.map((setting, i) => i);
    const worthy = all.filter((i) => report.highlights.includes(group().settings[i].name) &&
      !(group().value(counts, i, state.pair, last) < report.enough_matches));
    // Better poor ones than none.
    choose(ranked(worthy.length > 0 ? worthy : all));
  }
  function choose2014() {
    const names = new Set(report.reference.map((one) => one.setting));
    choose(group().settings.map((setting, i) => i).filter((i) => names.has(group().settings[i].name)));
  }
  function add(setting) {
    if (state.curves.length >= MAX_CURVES || state.curves.some((curve) => curve.setting === setting)) return;
    const used = new Set(state.curves.map((curve) => curve.color));
    const color = [...Array(MAX_CURVES).keys()].find((i) => !used.has(i));
    state.curves.push({ setting, color, hidden: false });
  }

  function seriesOf(curve) {
    const color = palette()[curve.color], name = group().settings[curve.setting].name;
    const points = (of) => places().map((place) => [tolerances[place].value, of(place)]);
    const series = [{
      type: "line", name, symbol: MARKS[curve.color], symbolSize: 8, lineStyle: { width: 2, color }, itemStyle: { color },
      data: points((place) => value(curve, place)), animation: false,
    }];
    if (state.intervals && state.pair !== MEAN && group().has(`${metric()}_low`)) {
      // A band is an invisible line with an area stacked on it.
      const band = { type: "line", name, silent: true, symbol: "none", stack: name, lineStyle: { width: 0 }, animation: false };
      series.push({ ...band, data: points((place) => limits(curve, place)[0]) });
      series.push({ ...band, areaStyle: { color, opacity: 0.15 }, data: points((place) => limits(curve, place)[1] - limits(curve, place)[0]) });
    }
    const past = places().map((place) => value2014(metric(), name, state.pair, place));
    if (state.with2014 && past.some((one) => one !== null)) {
      series.push({
        type: "line", name: `${name} (2014)`, symbol: "none", lineStyle: { width: 1.5, type: "dashed", color }, itemStyle: { color },
        data: places().map((place, i) => [tolerances[place].value, past[i]]), animation: false,
      });
    }
    return series;
  }

  function tooltipText(items) {
    const place = places().find((i) => tolerances[i].value === items[0].value[0]);
    const rows = items.filter((item) => item.value[1] !== null && !item.seriesName.endsWith("(2014)") && item.seriesIndex in shownCurves)
      .map((item) => ({ item, curve: shownCurves[item.seriesIndex] })).filter((row) => row.curve)
      .sort((a, b) => b.item.value[1] - a.item.value[1])
      .map(({ item, curve }) => {
        const [low, high] = limits(curve, place);
        const interval = state.pair === MEAN || Number.isNaN(low) ? "" : ` (${formatValue(metric(), low)} to ${formatValue(metric(), high)})`;
        const past = value2014(metric(), item.seriesName, state.pair, place);
        return `${item.marker}${escaped(item.seriesName)}: <b>${formatValue(metric(), item.value[1])}</b>${interval}` +
          (past === null ? "" : `; 2014: ${format2014(metric(), past)}`);
      });
    return `within ${tolerances[place].label}<br>${rows.join("<br>")}`;
  }

  let shownCurves = [];  // By index of series; null for bands and 2014's.
  const chartElement = h("div", { class: "chart", role: "img" });
  function drawChart(chart) {
    const series = [];
    shownCurves = [];
    for (const curve of state.curves.filter((one) => !one.hidden)) {
      seriesOf(curve).forEach((one, i) => { series.push(one); shownCurves.push(i === 0 ? curve : null); });
    }
    chart.setOption({
      grid: { left: 64, right: 16, top: 16, bottom: 48 },
      tooltip: tooltip({ trigger: "axis", formatter: tooltipText }),
      xAxis: axis(state.unit === "cm" ? "Distance tolerance (cm)" : "Angular tolerance (°)", { nameGap: 28, min: 0 }),
      yAxis: axis(metricTitle(metric()), { nameGap: 46, min: 0 }), series,
    }, true);
    chartElement.setAttribute("aria-label", `${metricTitle(metric())} over the tolerance of ${shownCurves.filter(Boolean).length} settings; the values are in the table below`);
  }

  const chips = h("ul", { class: "chips", "aria-label": "Curves: press to hide or show" });
  const values = h("div", { class: "scroll" });
  function drawChips() {
    chips.replaceChildren(...state.curves.map((curve) => {
      const name = group().settings[curve.setting].name;
      return h("li", null,
        h("button", { type: "button", "aria-pressed": String(!curve.hidden), click: () => { curve.hidden = !curve.hidden; update(); } },
          h("span", { class: "swatch", style: `background:${palette()[curve.color]}` }), name),
        h("button", { type: "button", "aria-label": `Remove ${name}`, click: () => { state.curves = state.curves.filter((one) => one !== curve); update(); } }, "×"));
    }));
  }
  function drawValues() {
    const shown = state.curves.filter((curve) => !curve.hidden);
    values.replaceChildren(h("table", null,
      h("thead", null, h("tr", null, h("th", { scope: "col" }, "Tolerance"), shown.map((curve) => h("th", { scope: "col", class: "number" }, group().settings[curve.setting].name)))),
      h("tbody", null, places().map((place) => h("tr", null, h("th", { scope: "row" }, tolerances[place].label),
        shown.map((curve) => h("td", { class: "number" }, formatValue(metric(), value(curve, place)))))))));
  }

  const suggestions = h("ul", { class: "suggestions" });
  const search = h("input", { type: "search", placeholder: "SIFT nopol FREAK", input: suggest });
  function suggest() {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const found = words.length === 0 ? [] : group().settings.map((setting, i) => i)
      .filter((i) => matchesWords(group().settings[i].name, words)).slice(0, MAX_SUGGESTIONS);
    suggestions.replaceChildren(...found.map((i) => h("li", null,
      h("button", { type: "button", click: () => { add(i); search.value = ""; suggest(); update(); search.focus(); } }, `+ ${group().settings[i].name}`))));
  }

  let redraw = () => {};
  function update() {
    const focused = [...chips.querySelectorAll("button")].indexOf(document.activeElement);
    drawChips();
    if (focused >= 0) chips.querySelectorAll("button")[Math.min(focused, chips.querySelectorAll("button").length - 1)]?.focus();
    drawValues();
    redraw();
  }
  const button = (text, action) => h("button", { type: "button", class: "plain", click: () => { action(); update(); } }, text);

  target.append(
    h("div", { class: "controls" },
      choice("Measure", measures, state.measure, (value) => {
        const before = kind();
        state.measure = value;
        if (kind() !== before) chooseBest();
        update();
      }),
      choice("Pair", pairChoices(), state.pair, (value) => { state.pair = Number(value); update(); }),
      report.tolerances_deg.length > 0 ? choice("Tolerance", [["cm", "distance"], ["°", "angle"]], "cm", (value) => { state.unit = value; update(); }) : null,
      check("95 % intervals (single pairs)", false, (on) => { state.intervals = on; update(); }),
      report.reference.length > 0 ? check("2014, dashed (single pairs)", false, (on) => { state.with2014 = on; update(); }) : null),
    chartElement, chips,
    h("div", { class: "controls" },
      h("label", null, `Add a setting (up to ${MAX_CURVES})`, search),
      button("Best ones", chooseBest),
      report.reference.length > 0 ? button("Those of 2014", choose2014) : null,
      button("None", () => choose([]))),
    suggestions,
    h("details", null, h("summary", null, "The values of these curves"), values));
  chooseBest();
  update();
  redraw = makeChart(chartElement, drawChart);
}

drawCurves();
