// Small helpers of the page.

// An element with attributes (functions are listeners) and children (nodes or text).
function h(tag, attributes, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (typeof value === "function") element.addEventListener(name, value);
    else if (value !== null && value !== undefined && value !== false) element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return element;
}

function section(id) { return document.getElementById(id); }
function note(text) { return h("p", { class: "note" }, text); }

// A labelled choice; options are [value, text] or { group, options }.
function choice(label, options, selected, onChange) {
  const option = ([value, text]) => h("option", { value, selected: String(value) === String(selected) }, text);
  const select = h("select", { change: (event) => onChange(event.target.value) },
    options.map((one) => one.group ? h("optgroup", { label: one.group }, one.options.map(option)) : option(one)));
  return h("label", null, label, select);
}

function check(label, checked, onChange) {
  return h("label", { class: "check" },
    h("input", { type: "checkbox", checked, change: (event) => onChange(event.target.checked) }), ` ${label}`);
}

// Okabe and Ito (2008), the clearest first; dark pages take lighter black and blue.
const isDark = matchMedia("(prefers-color-scheme: dark)");
function palette() {
  const dark = isDark.matches;
  return [dark ? "#56B4E9" : "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", dark ? "#3d8fd6" : "#56B4E9",
    dark ? "#ffffff" : "#000000", dark ? "#F0E442" : "#b8ab00"];
}
const MARKS = ["circle", "rect", "triangle", "diamond", "emptyCircle", "emptyRect", "emptyTriangle", "emptyDiamond"];

// A chart that follows the page's width and colours; draw(chart) sets its options.
const charts = [];
function makeChart(element, draw) {
  const chart = echarts.init(element, null, { renderer: "canvas" });
  const redraw = () => draw(chart);
  const refit = () => { chart.resize(); redraw(); };
  new ResizeObserver(refit).observe(element);
  charts.push({ refit, redraw });
  redraw();
  return redraw;
}
isDark.addEventListener("change", () => charts.forEach((one) => one.redraw()));
addEventListener("beforeprint", () => charts.forEach((one) => one.refit()));

// What charts have in common.
function chartColors() {
  const style = getComputedStyle(document.documentElement);
  const color = (name) => style.getPropertyValue(name).trim();
  return { ink: color("--ink"), soft: color("--soft"), line: color("--line"), paper: color("--paper") };
}
function axis(name, extra) {
  const colors = chartColors();
  return {
    type: "value", name, nameLocation: "middle", nameTextStyle: { color: colors.soft, fontSize: 13 },
    axisLabel: { color: colors.soft, fontSize: 12 }, axisLine: { show: true, lineStyle: { color: colors.soft } },
    splitLine: { lineStyle: { color: colors.line } }, ...extra,
  };
}
function tooltip(extra) {
  const colors = chartColors();
  return { backgroundColor: colors.paper, borderColor: colors.line, textStyle: { color: colors.ink, fontSize: 13 }, confine: true, ...extra };
}
// Names go into tooltips as text, not as markup.
function escaped(text) { return h("span", null, String(text)).innerHTML; }

function matchesWords(name, words) {
  const lower = ` ${name.toLowerCase()}`;
  return words.every((word) => lower.includes(` ${word}`));
}
