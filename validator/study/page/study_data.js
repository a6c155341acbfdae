// The study's data: what the program wrote, and how to read it.
const study = JSON.parse(document.getElementById("data").textContent);

const tolerances = [
  ...study.tolerances_m.map((value) => ({ value: 100 * value, unit: "cm" })),
  ...study.tolerances_deg.map((value) => ({ value, unit: "°" })),
].map((one) => ({ ...one, label: `${+one.value.toPrecision(6)} ${one.unit}` }));
const verdictTolerance = Math.max(0, study.tolerances_m.indexOf(study.tolerance_m));

const KINDS = { triplets: "Triplets", detectors: "Detectors" };
const SHARE = { triplets: "matching_score", detectors: "repeatability" };

// One of mean, low, high, change, change_low, change_high of a setting at a level; NaN where there is none.
function effect(factor, kind, metric, part, setting, level, tolerance) {
  const data = study.factors[factor][kind][metric];
  if (!data) return NaN;
  data.decoded ??= {};
  data.decoded[part] ??= decodeFloats(data[part]);
  const at = data.count > 1 ? tolerance : 0;
  return data.decoded[part][(setting * study.factors[factor].labels.length + level) * data.count + at];
}
// The share of the variance that the levels explain.
function explained(factor, kind, metric, setting, tolerance) {
  const data = study.factors[factor][kind][metric];
  if (!data) return NaN;
  data.decoded ??= {};
  data.decoded.explained ??= decodeFloats(data.explained);
  return data.decoded.explained[setting * data.count + (data.count > 1 ? tolerance : 0)];
}
function hasTolerance(factor, kind, metric) { return study.factors[factor][kind][metric].count > 1; }

// Measures to choose from, by kind; a measure is "kind metric".
function measures(factor) {
  return Object.keys(KINDS).map((kind) => ({
    group: KINDS[kind], options: Object.keys(study.factors[factor][kind]).map((metric) => [`${kind} ${metric}`, metricTitle(metric)]),
  })).filter((one) => one.options.length > 0);
}
function factorChoices() { return study.factors.map((factor, i) => [i, factor.title]); }
function toleranceChoices() { return tolerances.map((one, i) => [i, one.label]); }

// Levels as they go along an axis: numbers by size, words as they come.
function levelOrder(factor) {
  const { numeric, numbers, labels } = study.factors[factor];
  const order = labels.map((label, i) => i);
  return numeric ? order.sort((a, b) => numbers[a] - numbers[b]) : order;
}

// "+3.1 [+2.0 to +4.2]", a change with its interval; shares in points of a hundred.
function changeText(interval, scale, decimals) {
  const sign = (value) => `${value < 0 ? "−" : "+"}${Math.abs(scale * value).toFixed(decimals)}`;
  if (interval.mean === null) return "–";
  return sign(interval.mean) + (interval.low === null ? "" : ` [${sign(interval.low)} to ${sign(interval.high)}]`);
}
function pointsText(interval) { return changeText(interval, 100, 1); }
function countText(interval) { return changeText(interval, 1, 0); }
function percentText(share) { return share === null || Number.isNaN(share) ? "–" : `${Math.round(100 * share)} %`; }
