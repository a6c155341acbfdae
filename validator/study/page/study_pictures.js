// The same place at all levels of a factor, and how the study was made.

function drawPictures() {
  const target = section("pictures");
  if (study.pictures.length === 0) {
    target.append(note("There are no pictures: the sequences of the study are not there."));
    return;
  }
  study.factors.forEach((factor, i) => {
    const own = study.pictures.filter((picture) => picture.factor === i);
    const views = [...new Set(own.map((picture) => picture.view))];
    if (views.length === 0) return;
    if (study.factors.length > 1) target.append(h("h3", null, factor.title));
    const holder = h("div", { class: "levels" });
    const show = (view) => holder.replaceChildren(...levelOrder(i).flatMap((level) => own.filter((one) => one.level === level && one.view === view)).map((one) =>
      h("figure", null,
        h("img", { class: "detail", src: one.detail, alt: `Detail of ${view} at ${factor.title} ${factor.labels[one.level]}` }),
        h("img", { src: one.whole, alt: `${view} at ${factor.title} ${factor.labels[one.level]}` }),
        h("figcaption", null, factor.labels[one.level] + (one.level === factor.base ? " (base)" : "")))));
    if (views.length > 1) target.append(h("div", { class: "controls" }, choice("View", views.map((view) => [view, view]), views[0], show)));
    target.append(holder);
    show(views[0]);
    target.append(note(`${factor.title}: a detail of ${own[0].detail_px} px in the image's own pixels, and the whole image; first repetition.`));
  });
}

function drawMade() {
  const target = section("made");
  target.append(h("pre", null, study.command));
  target.append(h("p", null, `The study as it was run (study.yaml):`), h("details", null, h("summary", null, "study.yaml"), h("pre", null, study.study)));
  target.append(h("details", null, h("summary", null, `${study.variants.length} variants, each with its sequence and benchmark in variants/`),
    h("div", { class: "scroll" }, h("table", null,
      h("thead", null, h("tr", null, ["Variant", "Measured", "Programs"].map((text) => h("th", { scope: "col" }, text)))),
      h("tbody", null, study.variants.map((one) => h("tr", null, h("td", { class: "name" }, one.name), h("td", null, one.finished || "not recorded"),
        h("td", null, `pfseq ${one.program}, OpenCV ${one.opencv}`))))))));
  study.credits.forEach((credits) => target.append(h("p", null, `Credits of the scene: ${credits}`)));
  const what = study.has_figures ? "script, SVG, PNG" : "script (gnuplot was missing)";
  target.append(h("details", null, h("summary", null, `${study.files.length} tables (CSV, LaTeX) and figures (${what}) lie beside this page`),
    h("ul", null, h("li", null, "All effects: tables/effects.csv"), study.files.map((file) => h("li", null, `${file.caption}: tables/${file.name}.csv, .tex; `,
      h("code", null, `cd figures && gnuplot ${file.name}.gp`))))));
  target.append(note("Means and intervals: Student's t (1908) over samples; changes and differences are paired by samples. Share of the variance: eta squared, the sum of squares between " +
    "the levels' means over the whole sum, analysis of variance in two ways, levels by samples (Fisher 1925). It depends on the levels that were chosen. " +
    `Written by pfseq ${study.version}. Charts: Apache ECharts ${echarts.version} (Apache-2.0).`));
}

drawPictures();
drawMade();
document.documentElement.dataset.ready = "true";
