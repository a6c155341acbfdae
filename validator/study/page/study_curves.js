// Curves over the levels of a factor, with bands or bars of their 95 % intervals.

const MAX_CURVES = 8;
const MAX_SUGGESTIONS = 8;

// Curves of { name, color, at(level) -> [mean, low, high] }. Levels that are words stand beside each other, curves a little apart.
function drawOverLevels(chart, factorIndex, curves, { title, format, order }) {
  const factor = study.factors[factorIndex];
  const place = (level, curve) => factor.numeric ? factor.numbers[level] : order.indexOf(level) + 0.09 * (curve - (curves.length - 1) / 2);
  const series = [], owners = [];
  curves.forEach((curve, i) => {
    const color = palette()[curve.color];
    const points = order.map((level) => [place(level, i), ...curve.at(level)]);
    const put = (one) => { series.push({ animation: false, name: curve.name, ...one }); owners.push(one.silent ? null : curve); };
    put({ type: "line", symbol: MARKS[curve.color], symbolSize: 8, lineStyle: { width: factor.numeric ? 2 : 0, color }, itemStyle: { color },
      data: points.map(([x, mean]) => [x, mean]) });
    const known = points.filter(([, , low, high]) => !Number.isNaN(low) && !Number.isNaN(high));
    const bound = { type: "line", silent: true, symbol: "none", tooltip: { show: false } };
    if (factor.numeric) {
      // A band is an invisible line with an area stacked on it.
      const band = { ...bound, stack: `band ${i}`, stackStrategy: "all", lineStyle: { width: 0 } };
      put({ ...band, data: known.map(([x, , low]) => [x, low]) });
      put({ ...band, areaStyle: { color, opacity: 0.15 }, data: known.map(([x, , low, high]) => [x, high - low]) });
    } else {
      put({ ...bound, lineStyle: { width: 1.5, color }, data: known.flatMap(([x, , low, high]) => [[x, low], [x, high], [x, null]]) });
    }
  });
  const names = order.map((level) => factor.labels[level]);
  const many = names.join("").length > 60 || (names.length > 5 && chart.getWidth() < 600);
  chart.setOption({
    grid: { left: 64, right: 16, top: 16, bottom: factor.numeric || !many ? 48 : 110 },
    tooltip: tooltip({ trigger: "axis", axisPointer: { type: "line" }, formatter: (items) => {
      const x = items[0].value[0];
      const level = factor.numeric ? factor.numbers.indexOf(x) : order[Math.round(x)];
      const rows = curves.map((curve) => ({ curve, at: curve.at(level) })).filter(({ at }) => !Number.isNaN(at[0])).sort((a, b) => b.at[0] - a.at[0])
        .map(({ curve, at }) => `<span style="color:${palette()[curve.color]}">&#9679;</span> ${escaped(curve.name)}: <b>${format(at[0])}</b>` +
          (Number.isNaN(at[1]) ? "" : ` (${format(at[1])} to ${format(at[2])})`));
      return `${escaped(factor.title)}: ${escaped(factor.labels[level])}<br>${rows.join("<br>")}`;
    } }),
    xAxis: factor.numeric ? axis(factor.title, { nameGap: 28, scale: true }) : axis("", {
      min: -0.5, max: order.length - 0.5, interval: 1, splitLine: { show: false }, axisTick: { show: false },
      axisLabel: { show: false },
    }),
    yAxis: axis(title, { nameGap: 46, scale: true, axisLine: { onZero: false, show: true, lineStyle: { color: chartColors().soft } } }), series,
  }, true);
  if (!factor.numeric) labelWords(chart, names, many);
}

// A value axis cannot carry words: they are drawn as a series of labels at its foot.
function labelWords(chart, names, slanted) {
  const colors = chartColors();
  const graphic = names.map((name, i) => {
    const [x] = chart.convertToPixel({ xAxisIndex: 0, yAxisIndex: 0 }, [i, 0]);
    return { type: "text", x, y: chart.getHeight() - (slanted ? 104 : 40), rotation: slanted ? -0.6 : 0, silent: true,
      style: { text: name, fill: colors.soft, fontSize: 12, align: slanted ? "left" : "center" } };
  });
  chart.setOption({ graphic: { elements: graphic } });
}

function drawCurves() {
  const target = section("curves");
  const start = study.ranking.find((i) => study.factors[i].samples > 0);
  if (start === undefined || measures(start).length === 0) {
    target.append(note("There is no metric to draw."));
    return;
  }
  const state = { factor: start, measure: measures(start)[0].options[0][0], tolerance: verdictTolerance, change: false, curves: [] };
  const kind = () => state.measure.split(" ")[0];
  const metric = () => state.measure.split(" ")[1];
  const names = () => study[kind()];
  const parts = () => state.change ? ["change", "change_low", "change_high"] : ["mean", "low", "high"];
  const at = (setting, level) => parts().map((part) => effect(state.factor, kind(), metric(), part, setting, level, state.tolerance));

  function choose(settings) { state.curves = settings.slice(0, MAX_CURVES).map((setting, color) => ({ setting, color, hidden: false })); }
  function chooseBest() {
    const base = study.factors[state.factor].base;
    const value = (i) => effect(state.factor, kind(), SHARE[kind()], "mean", i, base, state.tolerance);
    choose(names().map((name, i) => i).filter((i) => !Number.isNaN(value(i))).sort((a, b) => value(b) - value(a)).slice(0, 5));
  }
  function chooseCompared() {
    const compared = study.factors[state.factor].comparisons.filter((one) => one.kind === kind()).flatMap((one) => [one.a, one.b]);
    choose([...new Set(compared)].map((name) => names().indexOf(name)));
  }
  function add(setting) {
    if (state.curves.length >= MAX_CURVES || state.curves.some((curve) => curve.setting === setting)) return;
    const used = new Set(state.curves.map((curve) => curve.color));
    state.curves.push({ setting, color: [...Array(MAX_CURVES).keys()].find((i) => !used.has(i)), hidden: false });
  }

  const chartElement = h("div", { class: "chart", role: "img" });
  function drawChart(chart) {
    const shown = state.curves.filter((one) => !one.hidden);
    const title = metricTitle(metric()) + (state.change ? ", change" : "");
    drawOverLevels(chart, state.factor, shown.map((curve) => ({
      name: names()[curve.setting], color: curve.color, at: (level) => at(curve.setting, level),
    })), { title, format: (value) => state.change && !isCount(metric()) ? `${value < 0 ? "−" : "+"}${Math.abs(value).toFixed(3)}` : formatValue(metric(), value), order: levelOrder(state.factor) });
    chartElement.setAttribute("aria-label", `${title} over ${study.factors[state.factor].title} of ${shown.length} settings; the values are in the table below`);
  }

  const chips = h("ul", { class: "chips", "aria-label": "Curves: press to hide or show" });
  function drawChips() {
    chips.replaceChildren(...state.curves.map((curve) => {
      const name = names()[curve.setting];
      return h("li", null,
        h("button", { type: "button", "aria-pressed": String(!curve.hidden), click: () => { curve.hidden = !curve.hidden; update(); } },
          h("span", { class: "swatch", style: `background:${palette()[curve.color]}` }), name),
        h("button", { type: "button", "aria-label": `Remove ${name}`, click: () => { state.curves = state.curves.filter((one) => one !== curve); update(); } }, "×"));
    }));
  }
  const suggestions = h("ul", { class: "suggestions" });
  const search = h("input", { type: "search", placeholder: "SIFT FREAK", input: suggest });
  function suggest() {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const found = words.length === 0 ? [] : names().map((name, i) => i).filter((i) => matchesWords(names()[i], words)).slice(0, MAX_SUGGESTIONS);
    suggestions.replaceChildren(...found.map((i) => h("li", null,
      h("button", { type: "button", click: () => { add(i); search.value = ""; suggest(); update(); search.focus(); } }, `+ ${names()[i]}`))));
  }
  let redraw = () => {};
  function update() {
    const focused = [...chips.querySelectorAll("button")].indexOf(document.activeElement);
    drawChips();
    if (focused >= 0) chips.querySelectorAll("button")[Math.min(focused, chips.querySelectorAll("button").length - 1)]?.focus();
    redraw();
  }
  const button = (text, action) => h("button", { type: "button", class: "plain", click: () => { action(); update(); } }, text);
  target.append(
    h("div", { class: "controls" },
      study.factors.length > 1 ? choice("Factor", factorChoices(), state.factor, (value) => { state.factor = Number(value); update(); }) : null,
      choice("Measure", measures(start), state.measure, (value) => {
        const before = kind();
        state.measure = value;
        if (kind() !== before) chooseBest();
        update();
      }),
      choice("Tolerance", toleranceChoices(), state.tolerance, (value) => { state.tolerance = Number(value); update(); }),
      choice("Show", [["mean", "means, as measured"], ["change", "change against the base"]], "mean", (value) => { state.change = value === "change"; update(); })),
    chartElement, chips,
    h("div", { class: "controls" }, h("label", null, `Add a setting (up to ${MAX_CURVES})`, search),
      button("Best ones", chooseBest), button("Those compared", chooseCompared), button("None", () => choose([]))),
    suggestions,
    note("Bands and bars are 95 % intervals: of a mean they tell how places and scenes differ, of a change (paired) what the factor does."));
  chooseCompared();
  if (state.curves.length === 0) chooseBest();
  update();
  redraw = makeChart(chartElement, drawChart);
}

drawVerdict();
drawOvertaking();
drawCurves();
