// The report's data: what the program wrote, and how to read it.
const report = JSON.parse(document.getElementById("data").textContent);

const MEAN = -1;  // Stands for the mean over all pairs.

class Group {
  constructor(json) {
    this.settings = json.settings;
    this.metrics = json.metrics;
    this.decoded = {};
    this.index = new Map(json.settings.map((setting, i) => [setting.name, i]));
  }

  has(metric) { return metric in this.metrics; }
  hasTolerance(metric) { return this.metrics[metric].count > 1; }

  // Metrics to choose from; limits of intervals come with their metric.
  names() { return Object.keys(this.metrics).filter((name) => !/_(low|high)$/.test(name)); }

  // NaN where there is none. The mean needs a value on each pair.
  value(metric, setting, pair, tolerance) {
    if (!this.has(metric)) return NaN;
    this.decoded[metric] ??= decodeFloats(this.metrics[metric].values);
    const count = this.metrics[metric].count;
    const at = count > 1 ? tolerance : 0;
    const of = (i) => this.decoded[metric][(setting * report.cases.length + i) * count + at];
    if (pair !== MEAN) return of(pair);
    let sum = 0;
    for (let i = 0; i < report.cases.length; ++i) sum += of(i);
    return sum / report.cases.length;
  }
}

const groups = { triplets: new Group(report.triplets), detectors: new Group(report.detectors) };
const tolerances = [
  ...report.tolerances_m.map((value) => ({ value: 100 * value, unit: "cm" })),
  ...report.tolerances_deg.map((value) => ({ value, unit: "°" })),
].map((one) => ({ ...one, label: `${+one.value.toPrecision(6)} ${one.unit}` }));
const verdictTolerance = Math.max(0, report.tolerances_m.indexOf(report.verdict_tolerance_m));

// The 2014 figure of a setting at one of the twelve distances; null where there is none.
const reference2014 = new Map(report.reference.map((one) => [`${one.metric}|${one.pair}|${one.setting}`, one.values]));
function value2014(metric, setting, pair, tolerance) {
  if (pair === MEAN) return null;
  return reference2014.get(`${metric}|${report.cases[pair].pair}|${setting}`)?.[tolerance] ?? null;
}

// The report of 2014 gives shares with two decimals.
function format2014(metric, value) { return value === null || isCount(metric) ? formatValue(metric, value) : value.toFixed(2); }

function pairChoices() {
  const pairs = report.cases.map((one, i) => [i, one.label]);
  return pairs.length > 1 ? [[MEAN, "mean of all pairs"], ...pairs] : pairs;
}
