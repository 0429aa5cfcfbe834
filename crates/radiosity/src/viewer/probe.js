// ---- The probe: the nearest element that faces the eye under a place of the canvas.
function hit(x, y) {
  const { ahead, right, above, eye } = axes(), t = tangent();
  const aspect = canvas.clientWidth / canvas.clientHeight;
  const across = (2 * x / canvas.clientWidth - 1) * t * aspect, rise = (1 - 2 * y / canvas.clientHeight) * t;
  const ray = add(ahead, add(scale(right, across), scale(above, rise)));
  let best = { depth: Infinity, element: -1, back: false };
  shown.elements.forEach(([, a, b, c], element) => {
    // The ray passes inside of all three planes through the eye and a side: as where the picture is drawn.
    const [p, q, r] = [a, b, c].map(vertex => sub(shown.points[vertex], eye));
    const weights = [cross(r, q), cross(p, r), cross(q, p)].map(plane => dot(plane, ray));
    const back = weights.every(weight => weight <= 0);
    if (back ? !$("backs").checked : weights.some(weight => weight < 0)) return;
    const depth = dot(p, cross(r, q)) / (weights[0] + weights[1] + weights[2]);
    // A back is a little behind a front in the same place.
    if (depth > 0 && depth * (back ? 1 + 1e-6 : 1) < best.depth) best = { depth, element, back };
  });
  return { element: best.element, back: best.back, ray, point: add(eye, scale(ray, best.depth)) };
}
function unprobe() { $("probe").textContent = $("middle").checked ? "nothing in the middle" : "point at a surface"; }
function probe(x, y) {
  if (walk) walk.point(x, y);
  const { element, back } = hit(x, y);
  if (element < 0) return unprobe();
  if (back) return void ($("probe").textContent = "the back of " + record.patches[patch(element)].name);
  const row = (values, index) => values.slice(index * record.bands, (index + 1) * record.bands);
  const text = numbers => numbers.slice(0, 6).map(number => number.toPrecision(5)).join("  ") + (numbers.length > 6 ? "  …" : "");
  $("probe").textContent = [
    "patch       " + record.patches[patch(element)].name,
    "element     " + element,
    ...(estimated ? [
      "estimate    " + text(record.patches[patch(element)].estimate) + " W/m² ("
        + (100 * errorShare(record.patches[patch(element)])).toPrecision(2) + " % of the patch's mean irradiance)",
    ] : []),
    ...(shown === solution ? [
      "radiosity   " + text(row(record.radiosity, element)) + " W/m²",
      "irradiance  " + text(row(record.irradiance, element)) + " W/m²",
      ...($("unit").value === "lx" && measured() ? ["illuminance " + (179 * luminous(rgb(record.irradiance, element))).toPrecision(5) + " lx"] : []),
      "bound       " + text(record.bound) + " W/m²",
    ] : [
      "radiosity   " + text(shown.element(element)) + " W/m² (red, green, blue)",
      "unshot      " + text(shown.open(element)) + " W/m²",
    ]),
  ].join("\n");
}
