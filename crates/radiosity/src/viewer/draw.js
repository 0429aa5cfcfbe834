// ---- Drawing.
let waiting = false;
function redraw() {
  if (!waiting) requestAnimationFrame(draw);
  waiting = true;
}
function draw() {
  waiting = false;
  const sharp = window.devicePixelRatio || 1;
  canvas.width = canvas.clientWidth * sharp;
  canvas.height = canvas.clientHeight * sharp;
  gl.useProgram(program);
  gl.viewport(0, 0, canvas.width, canvas.height);
  gl.enable(gl.DEPTH_TEST);
  gl.enable(gl.CULL_FACE);
  gl.clearColor(0, 0, 0, 1);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.uniformMatrix4fv(uniform.view, false, matrix());
  gl.uniform1i(uniform.show, ["interpolated", "elements", "patches", "unshot", "estimate", "radiosity", "irradiance"].indexOf($("show").value));
  gl.uniform1f(uniform.k, exposure());
  gl.uniform1i(uniform.wireframe, $("wireframe").checked);
  gl.uniform1i(uniform.raw, $("show").value === "unshot");
  gl.uniform1i(uniform.plain, $("show").value === "estimate");
  gl.uniform1i(uniform.measured, measured());
  gl.uniform1f(uniform.most, most());
  gl.uniform3fv(uniform.tones, TONES.flat());
  legend();
  gl.uniform1i(uniform.lights, $("lights").checked);
  gl.uniform1i(uniform.back, false);
  gl.cullFace(gl.BACK);
  for (const run of runs) {
    const textured = run.picture >= 0 && $("textures").checked && $("show").value === "interpolated" && shown === solution;
    gl.uniform1i(uniform.textured, textured);
    if (textured) gl.bindTexture(gl.TEXTURE_2D, pictures[run.picture]);
    gl.drawArrays(gl.TRIANGLES, run.first, run.count);
  }
  if ($("backs").checked) {
    gl.uniform1i(uniform.back, true);
    gl.cullFace(gl.FRONT);
    // A little behind fronts in the same place.
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(2, 8);
    gl.drawArrays(gl.TRIANGLES, 0, 3 * order.length);
    gl.disable(gl.POLYGON_OFFSET_FILL);
  }
  if (walk) walk.overlays();
  if ($("middle").checked) probe(canvas.clientWidth / 2, canvas.clientHeight / 2);
  $("k").textContent = "K = " + exposure().toPrecision(3);
  $("speed").textContent = camera.speed.toPrecision(2);
}
const exposure = () => K * 2 ** Number($("exposure").value);

// ---- False colours: from 0 to what one lit place in fifty exceeds, rounded; the exposure moves that.
const measured = () => ["radiosity", "irradiance"].includes($("show").value);
const tops = Object.fromEntries(["radiosity", "irradiance"].map(kind => {
  const values = [];
  record.elements.forEach(([patch, ...corners]) => {
    if (record.patches[patch].emission.every(band => band === 0)) {
      values.push(luminous(kind === "radiosity" ? solution.vertex(corners[0]) : solution.irradiance(0, corners[0])));
    }
  });
  const lit = values.filter(value => value > 0).sort((a, b) => a - b);
  return [kind, lit[Math.floor(0.98 * lit.length)] ?? 1];
}));
// The next of 1, 2, 5, 10, ...
function round(value) {
  const ten = 10 ** Math.floor(Math.log10(value));
  return ten * [1, 2, 5, 10].find(step => step * ten >= value * 0.999);
}
const unitFactor = () => $("unit").value === "lx" ? 179 : 1;
const most = () => round((tops[$("show").value] ?? 1) * 2 ** -Number($("exposure").value) * unitFactor()) / unitFactor();
const short = value => Number(value.toPrecision(3)).toString();
function legend() {
  const estimates = $("show").value === "estimate", unit = $("unit").value;
  $("unit-choice").hidden = !measured();
  $("legend").hidden = !measured() && !estimates;
  if ($("legend").hidden) return;
  const steps = [0, 1, 2, 3, 4].map(step => short(step / 4 * most() * unitFactor()));
  const ticks = estimates ? ["≤ 0.1 %", "1 %", "≥ 10 %"] : [...steps.slice(0, 4), "≥ " + steps[4]];
  const words = unit === "lx" ? { radiosity: "luminous exitance", irradiance: "illuminance" } : { radiosity: "radiosity", irradiance: "irradiance" };
  const title = estimates ? "estimated error of a patch's mean irradiance" : `${words[$("show").value]}, ${unit}`;
  $("legend-title").textContent = title;
  $("ticks").replaceChildren(...ticks.map(tick => Object.assign(document.createElement("span"), { textContent: tick })));
  $("legend").setAttribute("aria-label", `${title}: dark violet to yellow is ${ticks[0]} to ${ticks[ticks.length - 1]}`);
}

// A picture of what is seen, as PNG.
function save() {
  draw();
  canvas.toBlob(picture => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(picture);
    link.download = `${record.scene.replace(/^.*[/\\]/, "").replace(/\.[^.]*$/, "") || "radiosity"}.png`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  });
}
