// The table of all settings over the levels of a factor: sorted and filtered.

const ROWS_AT_ONCE = 40;

function drawTable() {
  const target = section("settings");
  const start = study.ranking.find((i) => study.factors[i].samples > 0);
  if (start === undefined || measures(start).length === 0) {
    target.append(note("The results hold no settings."));
    return;
  }
  const state = { factor: start, measure: measures(start)[0].options[0][0], tolerance: verdictTolerance, filter: "", sort: null, descending: true, limit: ROWS_AT_ONCE };
  const kind = () => state.measure.split(" ")[0];
  const metric = () => state.measure.split(" ")[1];
  const names = () => study[kind()];
  const factor = () => study.factors[state.factor];
  const of = (part, setting, level) => effect(state.factor, kind(), metric(), part, setting, level, state.tolerance);
  const share = (setting) => explained(state.factor, kind(), metric(), setting, state.tolerance);

  function rows() {
    const words = state.filter.toLowerCase().split(/\s+/).filter(Boolean);
    const chosen = names().map((name, i) => i).filter((i) => matchesWords(names()[i], words));
    const sign = state.descending ? -1 : 1;
    if (state.sort === "name") return chosen.sort((a, b) => sign * names()[a].localeCompare(names()[b]));
    const key = (i) => { const value = sign * (state.sort === "explained" ? share(i) : of("mean", i, state.sort)); return Number.isNaN(value) ? Infinity : value; };
    const keys = new Map(chosen.map((i) => [i, key(i)]));
    return chosen.sort((a, b) => (keys.get(a) === keys.get(b) ? a - b : keys.get(a) - keys.get(b)));
  }
  function heading(id, text, isNumber) {
    const sorted = state.sort === id ? (state.descending ? "descending" : "ascending") : "none";
    return h("th", { scope: "col", class: isNumber ? "number" : null, "aria-sort": sorted }, h("button", { type: "button", "data-column": id, click: () => {
      state.descending = state.sort === id ? !state.descending : isNumber;
      state.sort = id;
      update(id);
    } }, text));
  }
  function cell(setting, level) {
    const value = of("mean", setting, level), low = of("low", setting, level);
    const change = of("change", setting, level), least = of("change_low", setting, level), most = of("change_high", setting, level);
    const scale = isCount(metric()) ? 1 : 100;
    const signed = (one) => `${one < 0 ? "−" : "+"}${Math.abs(scale * one).toFixed(isCount(metric()) ? 0 : 1)}`;
    const is_sure = least > 0 || most < 0;
    return h("td", { class: "number" }, formatValue(metric(), value), Number.isNaN(low) ? null : h("span", { class: "of" }, `± ${formatValue(metric(), value - low)}`),
      level === factor().base || Number.isNaN(change) ? null : h("span", { class: is_sure ? "of best" : "of" }, signed(change)));
  }

  const holder = h("div", { class: "scroll" });
  const count = h("p", { class: "count", role: "status" });
  const more = h("button", { type: "button", class: "plain", click: () => { state.limit += 5 * ROWS_AT_ONCE; update(); } }, "Show more");
  function update(focus) {
    if (state.sort === null) state.sort = factor().base;
    const chosen = rows();
    holder.replaceChildren(h("table", null,
      h("thead", null, h("tr", null, heading("name", "Setting", false),
        levelOrder(state.factor).map((level) => heading(level, factor().labels[level], true)), heading("explained", "explained", true))),
      h("tbody", null, chosen.slice(0, state.limit).map((i) => h("tr", null, h("td", { class: "name" }, names()[i]),
        levelOrder(state.factor).map((level) => cell(i, level)), h("td", { class: "number" }, percentText(share(i))))))));
    count.textContent = `${Math.min(state.limit, chosen.length)} of ${chosen.length} shown, ${names().length} in all, over ${factor().title}. Mean ± half of its 95 % interval; below it ` +
      `the change against ${factor().labels[factor().base]}${isCount(metric()) ? "" : " in points of 100"}, bold where its interval leaves out 0. Explained: share of the variance by the levels.`;
    more.hidden = chosen.length <= state.limit;
    if (focus !== undefined) holder.querySelector(`[data-column="${focus}"]`).focus();
  }
  target.append(h("div", { class: "controls" },
    study.factors.length > 1 ? choice("Factor", factorChoices(), state.factor, (value) => { state.factor = Number(value); state.sort = null; update(); }) : null,
    choice("Measure", measures(start), state.measure, (value) => { state.measure = value; state.sort = null; update(); }),
    choice("Tolerance", toleranceChoices(), state.tolerance, (value) => { state.tolerance = Number(value); update(); }),
    h("label", null, "Filter by words", h("input", { type: "search", id: "filter", placeholder: "SIFT FREAK",
      input: (event) => { state.filter = event.target.value; state.limit = ROWS_AT_ONCE; update(); } }))),
    count, holder, more);
  update();
}

drawTable();
