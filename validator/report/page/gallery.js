// Pictures of the sequence, the drive from above, and where matches fail.

function drawPictures() {
  const target = section("pictures");
  const gallery = report.gallery;
  gallery.remarks.forEach((remark) => target.append(note(remark)));
  if (gallery.pictures.length === 0 && gallery.drives.length === 0) {
    target.append(note("There are no pictures in this report."));
    return;
  }
  const cases = [...new Set(gallery.pictures.map((picture) => picture.case))];
  const holder = h("div");
  const show = (chosen) => holder.replaceChildren(...gallery.pictures.filter((picture) => picture.case === chosen).map((picture) =>
    h("figure", null,
      h("img", { src: picture.source, alt: `${picture.title}, ${picture.caption}`, width: picture.width, height: picture.height, loading: "lazy" }),
      h("figcaption", null, `${picture.title}. ${picture.caption}.`))));
  if (cases.length > 0) {
    if (cases.length > 1) {
      target.append(h("div", { class: "controls" }, choice("Pair", cases.map((i) => [i, report.cases[i].label]), cases[0], (value) => show(Number(value)))));
    }
    target.append(holder);
    show(cases[0]);
  }
  gallery.drives.forEach((drive) => drawDrive(target, drive));
}

function drawDrive(target, drive) {
  const points = [...drive.path, ...drive.marks.map((mark) => mark.at)];
  if (points.length === 0) return;
  target.append(h("h3", null, `The drive from above${report.sources.length > 1 ? `, ${report.sources[drive.source].sequence}` : ""}`));
  const element = h("div", { class: "chart square", role: "img", "aria-label": `Path of ${drive.path.length} frames; marked: ${drive.marks.map((mark) => mark.label).join(", ")}` });
  target.append(element);
  // The same scale on both axes.
  const range = [0, 1].map((i) => [Math.min(...points.map((p) => p[i])), Math.max(...points.map((p) => p[i]))]);
  const half = 0.6 * Math.max(range[0][1] - range[0][0], range[1][1] - range[1][0], 2);
  const middle = range.map(([low, high]) => (low + high) / 2);
  const limits = (i) => ({ min: Math.floor(middle[i] - half), max: Math.ceil(middle[i] + half) });
  makeChart(element, (chart) => {
    const side = Math.min(element.clientWidth - 80, element.clientHeight - 70);
    chart.setOption({
      grid: { left: 56, top: 16, width: side, height: side },
      tooltip: tooltip({ formatter: (item) => escaped(item.name || "path") + ` (${item.value[0].toFixed(1)} m, ${item.value[1].toFixed(1)} m)` }),
      xAxis: axis("x (m)", { nameGap: 28, ...limits(0) }), yAxis: axis("y (m)", { nameGap: 36, ...limits(1) }),
      series: [
        { type: "line", data: drive.path, symbolSize: 3, lineStyle: { color: chartColors().soft }, itemStyle: { color: chartColors().soft }, animation: false },
        { type: "scatter", data: drive.marks.map((mark) => ({ name: mark.label, value: mark.at })), symbolSize: 11, animation: false,
          itemStyle: { color: palette()[1] }, labelLayout: { hideOverlap: true }, label: { show: true, formatter: (item) => item.name, position: "right", color: chartColors().ink } },
      ],
    }, true);
  });
  target.append(note("World coordinates in metres; dots are the frames, marks the cameras of the pairs."));
}

function drawFailures() {
  const target = section("failures");
  const failures = report.gallery.failures;
  if (failures.length === 0) {
    target.append(note("Where matches fail is found together with the pictures; there are none in this report."));
    return;
  }
  const cases = [...new Set(failures.map((one) => one.case))];
  let chosen = cases[0];
  const redraws = [];
  target.append(h("p", null, "The share of attempted matches that are right within 10 cm in the world, by where the first view's key point lies."));
  if (cases.length > 1) {
    target.append(h("div", { class: "controls" }, choice("Pair", cases.map((i) => [i, report.cases[i].label]), chosen, (value) => {
      chosen = Number(value);
      redraws.forEach((redraw) => redraw());
    })));
  }
  const columns = h("div", { class: "columns" });
  target.append(columns);
  const quantities = [["radius", "Distance from the image's centre / circle's radius"], ["distance", "Distance from the camera"]];
  const hasBlur = failures.some((one) => one.blur.length > 0);
  if (hasBlur) quantities.push(["blur", "Way of the pixel during the exposure"]);
  for (const [quantity, title] of quantities) {
    const element = h("div", { class: "chart small", role: "img", "aria-label": `Share of correct matches by ${title.toLowerCase()}` });
    columns.append(h("div", null, h("h3", null, title), element));
    redraws.push(makeChart(element, (chart) => drawBins(chart, failures.filter((one) => one.case === chosen && one[quantity].length > 0), quantity)));
  }
  const blurred = report.sources.some((source) => source.variant === "realistic");
  target.append(note(`Sky has no place in the world: a match there is never right.${blurred ? hasBlur ? "" : " Over motion blur where the sequence has its map (pfseq render --outputs realistic,blur,...)." : " The images are clean: nothing is to be seen of motion blur."}`));
}

function drawBins(chart, tables, quantity) {
  if (tables.length === 0) { chart.clear(); return; }
  const labels = tables[0][quantity].map((bin) => bin.label);
  chart.setOption({
    grid: { left: 48, right: 8, top: 12 + 20 * tables.length, bottom: 64 },
    legend: { top: 0, left: 0, orient: "vertical", itemHeight: 10, textStyle: { color: chartColors().ink } },
    tooltip: tooltip({ trigger: "axis", formatter: (items) => `${escaped(items[0].name)}<br>` + items.map((item) => {
      const bin = tables[item.seriesIndex][quantity][item.dataIndex];
      return `${item.marker}${escaped(item.seriesName)}: ${bin.correct} of ${bin.attempted}`;
    }).join("<br>") }),
    xAxis: axis("", { type: "category", data: labels, axisLabel: { color: chartColors().soft, rotate: 40, fontSize: 11 } }),
    yAxis: axis("", { min: 0, max: 1 }),
    series: tables.map((table, i) => ({
      type: "bar", name: table.setting, itemStyle: { color: palette()[i] }, animation: false,
      data: table[quantity].map((bin) => bin.attempted === 0 ? null : bin.correct / bin.attempted),
    })),
  }, true);
}

drawPictures();
drawFailures();
document.documentElement.dataset.ready = "true";
