// ---- Keys.
const faster = factor => { camera.speed = Math.max(1 / 64, Math.min(64, camera.speed * factor)); redraw(); };
const toggle = id => { $(id).checked = !$(id).checked; };
const move = (forward, aside, rise) => {
  const { ahead, right } = axes(), step = 0.05 * camera.speed;
  const way = add(add(scale(ahead, forward), scale(right, aside)), scale(up, rise));
  camera.target = add(camera.target, scale(way, step));
};
const unshotKnown = () => record.recording.steps.some(step => step.open);
const choose = (id, value) => { $(id).value = value; };
const expose = step => choose("exposure", Number($("exposure").value) + step);
const nextCamera = () => {
  choose("cameras", (Number($("cameras").value) + 1) % views.length);
  viewFrom(views[$("cameras").value]);
};
const keys = {
  w: () => move(1, 0, 0), s: () => move(-1, 0, 0), a: () => move(0, -1, 0), d: () => move(0, 1, 0),
  e: () => move(0, 0, 1), q: () => move(0, 0, -1),
  arrowup: () => turn(0, 0.05), arrowdown: () => turn(0, -0.05),
  arrowleft: () => turn(-0.05, 0), arrowright: () => turn(0.05, 0),
  pageup: () => approach(0.9), pagedown: () => approach(1 / 0.9),
  "+": () => faster(2), "=": () => faster(2), "-": () => faster(0.5), "[": () => expose(-0.25), "]": () => expose(0.25),
  1: () => choose("show", "patches"), 2: () => choose("show", "elements"), 3: () => choose("show", "interpolated"),
  5: () => choose("show", "radiosity"), 6: () => choose("show", "irradiance"),
  y: () => choose("unit", $("unit").value === "lx" ? "W/m²" : "lx"),
  ...(estimated ? { 4: () => choose("show", "estimate") } : {}),
  ...(record.recording ? {
    ",": () => walk.go(walk.at() - 1), ".": () => walk.go(walk.at() + 1),
    arrowleft: event => event.shiftKey ? turn(-0.05, 0) : walk.go(walk.at() - 1),
    arrowright: event => event.shiftKey ? turn(0.05, 0) : walk.go(walk.at() + 1),
    home: () => walk.go(0), end: () => walk.go(walk.last), p: () => walk.toggle(),
    u: () => choose("show", $("show").value !== "unshot" && unshotKnown() ? "unshot" : "interpolated"),
    k: () => choose("links", { place: "all", all: "none", none: "place" }[$("links").value]),
  } : {}),
  f: () => toggle("wireframe"), t: () => toggle("textures"), l: () => toggle("lights"), b: () => toggle("backs"),
  x: () => { toggle("middle"); crossed(); }, c: nextCamera, r: firstView, i: save,
  h: () => { $("panel").open = !$("panel").open; },
};
function crossed() {
  $("cross").toggleAttribute("hidden", !$("middle").checked);
  unprobe();
}
window.addEventListener("keydown", event => {
  const key = keys[event.key.toLowerCase()];
  if (!key || event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "SELECT") return;
  // Sliders have arrows of their own.
  if (event.target.type === "range" && event.key.length > 1) return;
  if (event.key.length > 1) event.preventDefault();
  key(event);
  redraw();
});

// ---- The panel.
const tones = TONES.map(tone => `rgb(${tone.map(part => Math.round(255 * part)).join(" ")})`);
$("legend").querySelector("div").style.background = `linear-gradient(to right, ${tones.join(", ")})`;
if (estimated) {
  const option = document.querySelector("#show option[value=estimate]");
  option.hidden = option.disabled = $("key-4").hidden = $("word-4").hidden = false;
}
const sceneName = record.scene.replace(/^.*[/\\]/, "");
document.title = `${sceneName} – radiosity`;
$("title").textContent = sceneName;
$("size").textContent = `${record.patches.length} patches, ${record.elements.length} elements`;
canvas.setAttribute("aria-label", `${sceneName}: the light of ${$("size").textContent}`);
$("cameras").replaceChildren(...views.map((view, index) => new Option(view.name, index)));
$("camera-choice").hidden = views.length < 2;
$("texture-choice").hidden = record.pictures.length === 0;
$("panel").open = innerWidth >= 600;
for (const id of ["show", "unit", "wireframe", "textures", "lights", "backs", "exposure"]) $(id).addEventListener("input", redraw);
$("middle").addEventListener("input", () => { crossed(); redraw(); });
$("cameras").addEventListener("input", () => { viewFrom(views[$("cameras").value]); redraw(); });
$("faster").addEventListener("click", () => faster(2));
$("slower").addEventListener("click", () => faster(0.5));
$("reset").addEventListener("click", () => { firstView(); redraw(); });
$("save").addEventListener("click", save);
window.addEventListener("resize", redraw);
firstView();
show(solution);
const walk = record.recording ? walking(record.recording) : null;
if (walk) walk.go(walk.last);
redraw();
