// The table of all settings: sorted, filtered, best and second best marked.

const TABLE_COLUMNS = {
  triplets: ["matching_score", "correct_matches", "attempted", "precision", "recall", "spread_cells", "cpu_s"],
  detectors: ["repeatability", "matches", "detections_first", "nonredundant_repeatability", "uniformity", "spread_cells", "cpu_s"],
};
const LESS_IS_BETTER = new Set(["cpu_s"]);
const UNRANKED = new Set(["attempted", "detections_first"]);
const ROWS_AT_ONCE = 40;

function drawTable() {
  const target = section("settings");
  const kinds = ["triplets", "detectors"].filter((kind) => groups[kind].settings.length > 0);
  if (kinds.length === 0 || report.cases.length === 0) {
    target.append(note("The results hold no settings."));
    return;
  }
  const state = { kind: kinds[0], pair: report.cases.length > 1 ? MEAN : 0, tolerance: verdictTolerance, filter: "", sort: null, descending: true, limit: ROWS_AT_ONCE };
  const group = () => groups[state.kind];
  const columns = () => TABLE_COLUMNS[state.kind].filter((metric) => group().has(metric));
  const value = (metric, i) => group().value(metric, i, state.pair, state.tolerance);
  const countOf = () => state.kind === "triplets" ? "correct_matches" : "matches";

  // The best and second best of a column, of all settings with enough matches.
  function marks(metric) {
    if (UNRANKED.has(metric)) return [];
    const sign = LESS_IS_BETTER.has(metric) ? -1 : 1;
    let best = [], values = [-Infinity, -Infinity];
    group().settings.forEach((setting, i) => {
      const one = sign * value(metric, i);
      if (Number.isNaN(one) || one <= values[1] || value(countOf(), i) < report.enough_matches) return;
      [best, values] = one > values[0] ? [[i, best[0]], [one, values[0]]] : [[best[0], i], [values[0], one]];
    });
    return best;
  }

  function rows() {
    const words = state.filter.toLowerCase().split(/\s+/).filter(Boolean);
    const chosen = group().settings.map((setting, i) => i).filter((i) => matchesWords(group().settings[i].name, words));
    const sign = state.descending ? -1 : 1;
    if (state.sort === "name") {
      chosen.sort((a, b) => sign * group().settings[a].name.localeCompare(group().settings[b].name));
    } else {
      // What has no value comes last either way.
      const keys = new Map(chosen.map((i) => [i, sign * value(state.sort, i)]).map(([i, key]) => [i, Number.isNaN(key) ? Infinity : key]));
      chosen.sort((a, b) => (keys.get(a) === keys.get(b) ? a - b : keys.get(a) - keys.get(b)));
    }
    return chosen;
  }

  function heading(id, text, isNumber) {
    const sorted = state.sort === id ? (state.descending ? "descending" : "ascending") : "none";
    return h("th", { scope: "col", class: isNumber ? "number" : null, "aria-sort": sorted },
      h("button", { type: "button", "data-column": id, click: () => {
        state.descending = state.sort === id ? !state.descending : isNumber && !LESS_IS_BETTER.has(id);
        state.sort = id;
        update(id);
      } }, text));
  }

  const holder = h("div", { class: "scroll" });
  const count = h("p", { class: "count", role: "status" });
  const more = h("button", { type: "button", class: "plain", click: () => { state.limit += 5 * ROWS_AT_ONCE; update(); } }, "Show more");
  function update(focus) {
    if (!columns().includes(state.sort) && state.sort !== "name") state.sort = columns()[0];
    const chosen = rows();
    const marked = new Map(columns().map((metric) => [metric, marks(metric)]));
    const share = state.kind === "triplets" ? "matching_score" : "repeatability";
    const has2014 = state.pair !== MEAN && report.reference.some((one) => one.metric === share && one.pair === report.cases[state.pair].pair);
    holder.replaceChildren(h("table", null,
      h("thead", null, h("tr", null, heading("name", "Setting", false), columns().map((metric) => heading(metric, metricTitle(metric), true)),
        has2014 ? h("th", { scope: "col", class: "number" }, "in 2014") : null)),
      h("tbody", null, chosen.slice(0, state.limit).map((i) => h("tr", null, h("td", { class: "name" }, group().settings[i].name),
        columns().map((metric) => {
          const rank = marked.get(metric).indexOf(i);
          return h("td", { class: `number${rank === 0 ? " best" : rank === 1 ? " second" : ""}` }, formatValue(metric, value(metric, i)));
        }),
        has2014 ? h("td", { class: "number" }, format2014(share, value2014(share, group().settings[i].name, state.pair, state.tolerance))) : null)))));
    count.textContent = `${Math.min(state.limit, chosen.length)} of ${chosen.length} shown, ${group().settings.length} in all. ` +
      `Bold is best, underlined second best of all with at least ${report.enough_matches} matches.`;
    more.hidden = chosen.length <= state.limit;
    if (focus) holder.querySelector(`[data-column="${focus}"]`).focus();
  }

  target.append(h("div", { class: "controls" },
    choice("Settings", kinds.map((kind) => [kind, kind]), state.kind, (value) => { state.kind = value; state.sort = null; state.descending = true; update(); }),
    choice("Pair", pairChoices(), state.pair, (value) => { state.pair = Number(value); update(); }),
    choice("Tolerance", tolerances.map((one, i) => [i, one.label]), state.tolerance, (value) => { state.tolerance = Number(value); update(); }),
    h("label", null, "Filter by words", h("input", { type: "search", id: "filter", placeholder: "SIFT nopol BruteForce",
      input: (event) => { state.filter = event.target.value; state.limit = ROWS_AT_ONCE; update(); } }))),
    count, holder, more);
  update();
}

drawTable();
