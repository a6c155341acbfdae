// Metrics: what people call them, and how their values are packed and written.

// As people read them; metrics without an entry are shown under their own name.
const METRICS = {
  matches: "Matches", repeatability: "Repeatability", repeatability_reference: "Repeatability by the first view",
  nonredundant_repeatability: "Non-redundant repeatability", correct_matches: "Correct matches", matching_score: "Matching score",
  precision: "Precision", recall: "Recall", survival_rate: "Survival rate", attempted: "Attempted matches",
  spread_cells: "Spread: occupied cells", spread_deviation: "Spread: standard deviation", spread_distance: "Spread: mean distance",
  spread_coverage: "Spread: coverage", uniformity: "Uniformity", detections_first: "Detections, first view",
  detections_second: "Detections, second view", cpu_s: "CPU time",
};
const COUNTS = /^(matches|correct_matches|attempted|detections_)/;

// Base64 of little-endian float32; only decoded when a metric is looked at.
function decodeFloats(text) {
  const bytes = atob(text);
  const raw = new Uint8Array(bytes.length);
  for (let i = 0; i < bytes.length; ++i) raw[i] = bytes.charCodeAt(i);
  return new Float32Array(raw.buffer);
}

function metricTitle(metric) { return METRICS[metric] ?? metric.replaceAll("_", " "); }
function isCount(metric) { return COUNTS.test(metric); }
function formatValue(metric, value) {
  if (value === null || Number.isNaN(value)) return "–";
  if (isCount(metric)) return Math.round(value).toLocaleString("en");
  return metric === "cpu_s" ? `${value.toFixed(2)} s` : value.toFixed(3);
}
