// Leafs through a sequence; asks the server for pictures and pixels.

const byId = (id) => document.getElementById(id);
const state = { sequence: null, lens: null, frame: 0, picked: null };

function make(tag, attributes, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes ?? {})) element.setAttribute(name, value);
  element.append(...children);
  return element;
}
const query = (values) => new URLSearchParams(values).toString();

// A picture of each channel and camera.
function drawViews() {
  const views = byId("views");
  const { cameras, width_px, height_px } = state.sequence;
  views.style.setProperty("--cameras", cameras.length);
  views.style.setProperty("--aspect", `${width_px} / ${height_px}`);
  views.replaceChildren(...state.lens.channels.flatMap((channel) => cameras.map((camera) => {
    const address = `/picture?${query({ lens: state.lens.name, camera, channel, frame: state.frame })}`;
    const title = `${camera}, ${channel}`;
    const frame = make("div", { class: "frame", tabindex: "0", "data-camera": camera, "data-channel": channel, "aria-label": title },
      make("img", { src: address, alt: title }));
    frame.addEventListener("click", (event) => {
      const box = frame.getBoundingClientRect();
      const place = (offset, length, count) => Math.min(count - 1, Math.max(0, Math.floor((offset / length) * count)));
      frame.focus({ preventScroll: true });
      pick(camera, place(event.clientX - box.left, box.width, width_px), place(event.clientY - box.top, box.height, height_px));
    });
    frame.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
      if (!step) return;
      event.preventDefault();
      const from = state.picked?.camera === camera ? state.picked : { x: width_px >> 1, y: height_px >> 1 };
      const inside = (value, count) => Math.min(count - 1, Math.max(0, value));
      pick(camera, inside(from.x + step[0], width_px), inside(from.y + step[1], height_px));
    });
    return make("figure", null, frame, make("figcaption", null, title));
  })));
}

function mark(camera, x_px, y_px, isOther) {
  for (const frame of document.querySelectorAll(`.frame[data-camera="${CSS.escape(camera)}"]`)) {
    frame.append(make("span", { class: isOther ? "mark other" : "mark",
      style: `left:${(100 * x_px) / state.sequence.width_px}%;top:${(100 * y_px) / state.sequence.height_px}%` }));
  }
}

const metres = (value) => value === null ? "none" : `${value.toFixed(3)} m`;
const vector = (values, digits) => values.map((value) => value.toFixed(digits)).join(", ");

function show(pixel) {
  document.querySelectorAll(".mark").forEach((one) => one.remove());
  mark(state.picked.camera, pixel.x + 0.5, pixel.y + 0.5, false);
  const rows = [["Camera", `${state.picked.camera}, frame ${state.frame}`], ["Pixel", `${pixel.x}, ${pixel.y}`]];
  if (!pixel.in_circle) {
    rows.push(["Ray", "outside the image circle"]);
  } else {
    rows.push(["Angle to the axis", `${pixel.incidence_deg.toFixed(3)}°`], ["Ray in the camera", vector(pixel.direction_camera, 5)],
      ["Ray in the world", vector(pixel.direction_world, 5)], ["Distance", pixel.sky ? "sky" : metres(pixel.distance_m)]);
    if (pixel.point_world_m) rows.push(["Point in the world", `${vector(pixel.point_world_m, 3)} m`]);
  }
  for (const other of pixel.others) {
    const seen = other.x_px === null ? "outside its view"
      : `${other.x_px.toFixed(2)}, ${other.y_px.toFixed(2)} (${other.is_visible ? "visible" : "hidden"})`;
    rows.push([`In ${other.camera}`, seen], [`Distance from ${other.camera}`, `${metres(other.distance_m)}, its map there ${metres(other.map_distance_m)}`]);
    if (other.x_px !== null) mark(other.camera, other.x_px, other.y_px, true);
  }
  byId("answer").replaceChildren(make("table", null, make("tbody", null,
    ...rows.map(([name, value]) => make("tr", null, make("th", { scope: "row" }, name), make("td", { "data-name": name }, value))))));
}

let lastQuestion = 0;
async function pick(camera, x, y) {
  state.picked = { camera, x, y };
  const question = ++lastQuestion;
  const answer = await fetch(`/pixel?${query({ lens: state.lens.name, camera, frame: state.frame, x, y })}`);
  if (question !== lastQuestion) return;  // A later click counts.
  if (answer.ok) show(await answer.json());
  else byId("answer").replaceChildren(make("p", { class: "note" }, await answer.text()));
}

function turnTo(position) {
  state.frame = state.lens.frames[position];
  byId("frame-number").textContent = ` ${state.frame} (${position + 1} of ${state.lens.frames.length})`;
  drawViews();
  if (state.picked) pick(state.picked.camera, state.picked.x, state.picked.y);
}

function chooseLens(name) {
  state.lens = state.sequence.lenses.find((lens) => lens.name === name);
  const slider = byId("frame");
  slider.max = state.lens.frames.length - 1;
  slider.value = 0;
  turnTo(0);
}

async function start() {
  state.sequence = await (await fetch("/sequence")).json();
  byId("title").textContent = state.sequence.name;
  document.title = `${state.sequence.name} - pfseq view`;
  if (state.sequence.lenses.length === 0) {
    byId("views").textContent = "The sequence has no frames yet.";
    return;
  }
  byId("lens").append(...state.sequence.lenses.map((lens) => make("option", null, lens.name)));
  byId("lens").addEventListener("change", (event) => chooseLens(event.target.value));
  byId("frame").addEventListener("input", (event) => turnTo(Number(event.target.value)));
  chooseLens(state.sequence.lenses[0].name);
  document.documentElement.dataset.ready = "true";
}
start();
