// SPDX-License-Identifier: BSD-3-Clause
// Time, controls, and the words around the pictures.

const element = (id) => document.getElementById(id);
const data = JSON.parse(element("data").textContent);
const motions = data.runs.map((run) => new Motion(run));
const start = Math.min(...motions.map((m) => m.start)), end = Math.max(...motions.map((m) => m.end)), duration = end - start;
const SPEEDS = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50];
const theme = {};

function readTheme() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["paper", "ink", "soft", "rule", "sky", "floor", "line", "edge", "still"]) theme[name] = style.getPropertyValue("--" + name).trim();
}
readTheme();

/// Black in a dark page is the ink.
const colourOf = (i) => { const c = data.runs[i].colour; return c === "#000000" ? theme.ink : c; };
let colours = motions.map((_, i) => colourOf(i));

const anyMoves = (f) => data.scenes.some((s) => f(s));
const onlyTurns = motions.every((m) => m.moving === 1) && motions.every((m) => m.impactCount() === 0);
const vectors = motions.every((m) => m.moving <= FEW);
const rotates = data.runs.some((r) => r.fastest > 0);
const TOGGLES = [
  { key: "axes", label: "body axes", on: motions[0].moving <= 3, has: vectors, colour: `linear-gradient(90deg, ${AXES.join(", ")})` },
  { key: "omega", label: "angular velocity ω", on: onlyTurns, has: vectors && rotates, colour: OMEGA },
  { key: "momentum", label: "angular momentum L", on: onlyTurns, has: vectors && rotates, colour: MOMENTUM },
  { key: "trails", label: "trails", title: "of the mass centre, or where that stays, of the tip of ω", on: motions[0].moving <= 12, has: vectors },
  { key: "polhode", label: "polhode", title: "the curve of ω on the inertia ellipsoid, in the body", on: false, has: vectors && rotates, colour: OMEGA },
  { key: "springs", label: "springs", on: true, has: anyMoves((s) => s.springs.length > 0) },
  { key: "joints", label: "joints", title: "anchors, axes, and where bodies roll", on: true, has: anyMoves((s) => s.joints.length > 0) },
  { key: "reactions", label: "reactions", title: "force of each joint on its first body", on: true, has: motions.some((m) => m.joints > 0), colour: REACTION },
  { key: "floor", label: "floor", on: true, has: anyMoves((s) => s.bodies.some((b) => b.normal)) },
  { key: "follow", label: "follow the bodies", on: true, get has() { return sizes !== null && sizes.follows; } },
  { key: "marks", label: "contact marks", on: true, has: motions.some((m) => m.impactCount() > 0), colour: MARK },
  { key: "pause", label: "pause at impacts", on: false, has: motions.some((m) => m.impactCount() > 0) },
  { key: "loop", label: "repeat", on: true, has: true },
];
const shown = {};

const state = { t: start, playing: false, speed: 1, dirty: true, last: 0 };
let renderer = null, camera = null, controls = null, views = [], scales = { omega: 0, momentum: 0, force: 0 }, sizes = null, plot = null;
const panels = [], FEW_JOINTS = 6;  // with a line for each

function number(x) {
  if (!isFinite(x)) return String(x);
  if (x === 0) return "0";
  const text = Math.abs(x) >= 1e-3 && Math.abs(x) < 1e4 ? x.toPrecision(3) : x.toExponential(2);
  return text.replace("-", "−").replace("e-", "e−").replace("e+", "e");
}
const digits = Math.max(2, Math.min(6, 1 - Math.floor(Math.log10(Math.max(duration, 1e-9) / 1000))));
const seconds = (t) => t.toFixed(digits) + " s";

function make(tag, properties, ...children) {
  const e = Object.assign(document.createElement(tag), properties);
  e.append(...children);
  return e;
}

// Words.

function writeWords() {
  element("title").textContent = data.title;
  element("description").textContent = data.description;
  element("answer").append(...data.answer.map((text) => make("p", { textContent: text })));
  element("paragraphs").append(...data.paragraphs.map((text) => make("p", { textContent: text })));
  if (views.length && views[0].tile) element("paragraphs").append(make("p", { textContent: `A tile of the floor is ${number(views[0].tile)} m wide.` }));
  const names = [...new Set(data.runs.flatMap((r) => r.facts.map((f) => f[0])))];
  const row = (kind, title, cells) => make("tr", {}, make(kind, { textContent: title }), ...cells.map((c) => make("td", { textContent: c })));
  const body = make("tbody", {});
  names.forEach((name) => body.append(row("th", name, data.runs.map((r) => (r.facts.find((f) => f[0] === name) || ["", ""])[1]))));
  element("facts").append(make("thead", {}, row("th", "", data.runs.map((r) => r.label))), body);
  element("made").textContent = `Made by ${data.madeBy}, with three.js ${THREE.REVISION}. SI units throughout.`;
}

/// A line for each joint, or where there are many, for the one with the largest reaction: the cells of names and of forces.
function addForces(list, motion, joints) {
  if (motion.joints === 0) return [];
  return joints.slice(0, joints.length > FEW_JOINTS ? 1 : joints.length).map((joint) => {
    const line = { name: make("dt", { textContent: joint.name }), force: make("dd", {}) };
    list.append(line.name, line.force);
    return line;
  });
}

function writeForces(lines, motion, joints, t) {
  const at = motion.at(t), all = joints.map((j, i) => ({ name: j.name, force: motion.reaction(at, i, new THREE.Vector3()).length() }));
  if (lines.length < joints.length) all.sort((a, b) => b.force - a.force);
  lines.forEach((line, i) => {
    line.name.hidden = line.force.hidden = !shown.reactions;
    line.name.textContent = all[i].name;
    line.force.textContent = `${number(all[i].force)} N`;
  });
}

function makePanels() {
  data.runs.forEach((run, i) => {
    const swatch = make("span", {}), title = make("h3", {}, swatch, run.label), ended = make("p", { className: "ended" });
    const energy = make("dd", {}), momentum = make("dd", {}), list = make("dl", {}, make("dt", { textContent: "energy drift" }), energy);
    if (run.momentum) list.append(make("dt", { textContent: `${run.momentum} momentum drift` }), momentum);
    const forces = addForces(list, motions[i], data.scenes[run.scene].joints);
    element("views").append(make("div", { className: "view" }, title, make("p", { className: "detail", textContent: run.detail }), ended, list));
    const value = make("b", {}), dot = make("span", { className: "swatch" });
    element("legend").append(make("li", {}, dot, run.label + (run.detail ? `, ${run.detail}` : ""), value));
    panels.push({ ended, energy, momentum, forces, value, swatches: [swatch, dot] });
  });
}

function paintSwatches() {
  panels.forEach((p, i) => p.swatches.forEach((s) => {
    s.style.boxShadow = `inset 0 0 0 3px ${colours[i]}`;  // a ring stands for a dashed curve
    s.style.background = data.runs[i].dash.length ? "transparent" : colours[i];
  }));
}

// Pictures.

function makeViews() {
  for (const scene of data.scenes) {
    scene.geometries = scene.geometries || scene.surfaces.map(geometryOf);
    scene.bodies.forEach((b) => { if (b.surface !== undefined) b.radius = scene.geometries[b.surface].boundingSphere.radius; });
  }
  const sound = motions.filter((m) => m.run.status === "ok"), lasting = (m) => sound.length === 0 || sound.includes(m);
  sizes = sizesOf(data, motions.filter(lasting));  // a run that was lost sets no scale
  views = data.runs.map((run, i) => new View(data, run, motions[i], sizes, duration));
  scales = vectorScales(views.filter((v) => lasting(v.motion)));
}

function lookFromTheStart() {
  const { x: wide, y: deep, z: high } = sizes.box.getSize(new THREE.Vector3());
  const flat = Math.max(0, 1 - high / Math.max(wide, deep));  // what lies in a plane is seen from above
  const away = new THREE.Vector3(0.55, -1, sizes.level ? 0.42 : 0.2 + 0.7 * flat).normalize();
  const right = new THREE.Vector3(0, 0, 1).cross(away).normalize(), up = away.clone().cross(right);
  const box = element("views").children[0].getBoundingClientRect(), across = Math.max(1, box.width / box.height);
  const slope = Math.tan(0.5 * camera.fov * Math.PI / 180), x = new THREE.Vector3();
  let far = 0;
  for (let k = 0; k < 8; ++k) {  // so far that each corner of what is seen is in the picture
    for (let c = 0; c < 3; ++c) x.setComponent(c, (k >> c & 1 ? sizes.box.max : sizes.box.min).getComponent(c));
    x.sub(sizes.center);
    far = Math.max(far, x.dot(away) + 1.02 * Math.max(Math.abs(x.dot(up)), Math.abs(x.dot(right)) / across) / slope);
  }
  camera.position.copy(sizes.center).addScaledVector(away, far);
  controls.target.copy(sizes.center);
  controls.update();
  state.dirty = true;
}

function openStage() {
  try {
    renderer = new THREE.WebGLRenderer({ canvas: element("scene"), antialias: true, preserveDrawingBuffer: true });
  } catch (error) {
    element("failure").textContent = "This browser draws no WebGL: there are no pictures of the motion here, only its numbers.";
    element("failure").hidden = false;
    return;
  }
  renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = THREE.PCFShadowMap;
  makeViews();
  camera = new THREE.PerspectiveCamera(28, 1, 0.005 * sizes.view, 50 * sizes.view);
  camera.up.set(0, 0, 1);
  controls = new THREE.OrbitControls(camera, renderer.domElement);
  controls.enableKeys = false;
  // On a narrow page one finger scrolls, and two turn and zoom.
  controls.touches.TWO = isNarrow() ? THREE.TOUCH.DOLLY_ROTATE : THREE.TOUCH.DOLLY_PAN;
  element("stage").addEventListener("touchstart", (event) => { if (isNarrow() && event.touches.length === 1) event.stopPropagation(); }, true);
  controls.addEventListener("change", () => { state.dirty = true; });
}

const isNarrow = () => window.innerWidth < 700;

function layOut() {
  const n = data.runs.length, narrow = isNarrow(), stage = element("stage");
  const columns = narrow ? 1 : n <= 3 ? n : n === 4 ? 2 : n <= 6 ? 3 : 4, rows = Math.ceil(n / columns);
  const grid = element("views").style;
  grid.gridTemplateColumns = `repeat(${columns}, minmax(0, 1fr))`;
  grid.gridTemplateRows = `repeat(${rows}, minmax(0, 1fr))`;
  stage.style.height = narrow ? `${Math.round(rows * Math.max(230, 0.72 * window.innerWidth))}px`
                              : rows > 2 ? `${rows * 270}px`
                              : `clamp(17rem, calc(56vh - ${element("answer").offsetHeight}px), 60rem)`;  // the curves stay in the window
  if (renderer) renderer.setSize(stage.clientWidth, stage.clientHeight, false);
  plot.layout();
  state.dirty = true;
}

function render() {
  const stage = element("stage").getBoundingClientRect(), far = camera.position.distanceTo(controls.target);
  renderer.setScissorTest(false);
  renderer.setClearColor(theme.paper);
  renderer.clear();
  renderer.setScissorTest(true);
  views.forEach((view, i) => {
    const box = element("views").children[i].getBoundingClientRect();
    const width = box.width, height = box.height, left = box.left - stage.left, bottom = stage.bottom - box.bottom;
    renderer.setViewport(left, bottom, width, height);
    renderer.setScissor(left, bottom, width, height);
    camera.aspect = width / height;
    // Wide or narrow, the shorter side shows the same.
    camera.zoom = Math.min(1, camera.aspect);
    camera.updateProjectionMatrix();
    Object.assign(view.scene.fog, { near: far + 0.9 * sizes.view, far: far + 3.5 * sizes.view });
    camera.position.add(view.middle);
    renderer.render(view.scene, camera);
    camera.position.sub(view.middle);
  });
}

// Time.

function seek(t) {
  state.t = Math.min(end, Math.max(start, t));
  state.dirty = true;
}

function setPlaying(on) {
  if (on && state.t >= end) seek(start);
  state.playing = on;
  element("play").classList.toggle("playing", on);
  element("play").setAttribute("aria-label", on ? "Pause" : "Play");
}

function step(direction) {
  setPlaying(false);
  let next = direction > 0 ? end : start;
  for (const m of motions) {
    const k = m.instant(state.t), here = m.times[k];
    const candidate = direction > 0 ? m.times[k + 1] : here < state.t ? here : m.times[k - 1];
    if (candidate === undefined || candidate === state.t) continue;
    next = direction > 0 ? Math.min(next, candidate) : Math.max(next, candidate);
  }
  seek(next);
}

function advance(now) {
  const passed = Math.min(0.1, (now - state.last) / 1000);
  state.last = now;
  if (!state.playing || !(passed > 0)) return;
  let t = state.t + state.speed * passed;
  if (shown.pause) {
    const met = motions.map((m) => m.impactTime(m.firstImpactAfter(state.t))).filter((at) => at <= t);
    if (met.length > 0) {
      t = Math.min(...met);
      setPlaying(false);
    }
  }
  if (t >= end) {
    if (shown.loop && duration > 0) t = start;
    else setPlaying(false);
  }
  seek(t);
}

function show() {
  const t = state.t;
  views.forEach((view) => view.show(t, shown, scales, 0.35 * Math.max(state.speed, 1e-3)));
  motions.forEach((m, i) => {
    const k = m.instant(t), p = panels[i], run = data.runs[i];
    p.energy.textContent = p.value.textContent = number(m.energy[k]);
    if (p.forces.length > 0) writeForces(p.forces, m, data.scenes[run.scene].joints, t);
    if (m.momentumDrift) p.momentum.textContent = number(m.momentumDrift[k]);
    const over = t > m.end || (t >= m.end && m.end < end);
    p.ended.textContent = over || (run.status !== "ok" && t >= m.end) ? `${run.status === "ok" ? "ended" : run.status} at ${seconds(m.end)}` : "";
  });
  element("scrub").value = t;
  element("clock").textContent = `${t.toFixed(digits)} / ${seconds(end)}`;
  if (renderer) render();
  plot.draw(t);
}

function frame(now) {
  advance(now);
  if (state.dirty) {
    state.dirty = false;
    show();
  }
  requestAnimationFrame(frame);
}

// Controls.

function setSpeed(speed) {
  state.speed = speed;
  element("speed").value = String(speed);
  state.dirty = true;
}

function makeControls() {
  SPEEDS.forEach((s) => element("speed").append(make("option", { value: String(s), textContent: `${s} ×` })));
  const wanted = duration / 40;
  setSpeed(wanted > 1 ? SPEEDS.find((s) => s >= wanted) || 50 : duration >= 3 ? 1 : [...SPEEDS].reverse().find((s) => s <= duration / 5) || 0.001);
  Object.assign(element("scrub"), { min: start, max: end });
  element("scrub").addEventListener("input", () => { setPlaying(false); seek(Number(element("scrub").value)); });
  element("speed").addEventListener("change", () => setSpeed(Number(element("speed").value)));
  element("play").addEventListener("click", () => setPlaying(!state.playing));
  element("home").addEventListener("click", () => { setPlaying(false); seek(start); });
  element("back").addEventListener("click", () => step(-1));
  element("forth").addEventListener("click", () => step(1));
  TOGGLES.forEach((toggle) => {
    shown[toggle.key] = toggle.on && toggle.has;
    if (!toggle.has) return;
    const box = make("input", { type: "checkbox", id: `show-${toggle.key}`, checked: toggle.on }), label = make("label", { title: toggle.title || "" }, box);
    if (toggle.colour) label.append(make("i", { style: `background: ${toggle.colour}` }));
    label.append(toggle.label);
    box.addEventListener("change", () => { shown[toggle.key] = box.checked; state.dirty = true; });
    element("toggles").append(label);
  });
  // After a click the keys are the page's again; who got there by keys stays there.
  document.addEventListener("click", (event) => { if (event.detail > 0 && event.target.matches("button, button *, #toggles input, #scrub")) document.activeElement.blur(); });
  const canvas = element("plot");
  const scrub = (event) => { setPlaying(false); seek(plot.time(event.offsetX)); };
  canvas.addEventListener("pointerdown", (event) => { canvas.setPointerCapture(event.pointerId); scrub(event); });
  canvas.addEventListener("pointermove", (event) => { if (event.buttons) scrub(event); });
}

function onKey(event) {
  const has = (what) => event.target.matches(what);  // what has the focus and a meaning for the key of its own
  if (event.ctrlKey || event.metaKey || event.altKey || has("select") || (event.key === " " && has("button, input[type=checkbox]"))) return;
  const faster = SPEEDS.find((s) => s > state.speed), slower = [...SPEEDS].reverse().find((s) => s < state.speed);
  const jump = (d) => { setPlaying(false); seek(state.t + d * duration / 50); };
  const keys = {
    " ": () => setPlaying(!state.playing),
    ArrowLeft: () => (event.shiftKey ? jump(-1) : step(-1)),
    ArrowRight: () => (event.shiftKey ? jump(1) : step(1)),
    Home: () => { setPlaying(false); seek(start); },
    End: () => { setPlaying(false); seek(end); },
    "+": () => faster && setSpeed(faster),
    "=": () => faster && setSpeed(faster),
    "-": () => slower && setSpeed(slower),
    l: () => element("show-loop").click(),
    r: () => renderer && lookFromTheStart(),
  };
  const act = keys[event.key] || keys[event.key.toLowerCase()];
  if (!act) return;
  event.preventDefault();
  act();
}

makePanels();
openStage();
makeControls();
plot = new Plot(element("plot"), motions, colours, start, end);
paintSwatches();
writeWords();
layOut();
if (renderer) lookFromTheStart();
window.addEventListener("resize", layOut);
window.addEventListener("keydown", onKey);
window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
  readTheme();
  colours = motions.map((_, i) => colourOf(i));
  plot.colours = colours;
  paintSwatches();
  if (renderer) makeViews();
  layOut();
});
requestAnimationFrame((now) => { state.last = now; frame(now); });

/// For the console, and for pages that show this one: where time is, and where a body or a joint of a view is drawn.
window.replay = {
  start, end, seek, play: () => setPlaying(true), pause: () => setPlaying(false),
  get time() { return state.t; },
  get playing() { return state.playing; },
  body(view, body) {
    const at = motions[view].at(state.t), p = new THREE.Vector3(), q = new THREE.Quaternion();
    motions[view].position(at, body, p);
    motions[view].orientation(at, body, q);
    return { position: p.toArray(), orientation: [q.w, q.x, q.y, q.z] };
  },
  joint(view, joint) {
    show();
    const shownJoint = views[view].joints[joint], at = motions[view].at(state.t);
    return { name: shownJoint.data.name, point: shownJoint.point().toArray(), force: shownJoint.force(at).toArray() };
  },
};
