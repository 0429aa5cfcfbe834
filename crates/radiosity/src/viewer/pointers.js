// ---- Pointers: one turns, the right button or two shift and pinch.
const pointers = new Map();
const shift = (dx, dy) => {
  const { right, above } = axes(), step = 2 * tangent() * camera.distance / canvas.clientHeight;
  camera.target = add(camera.target, add(scale(right, -dx * step), scale(above, dy * step)));
};
canvas.addEventListener("pointerdown", event => {
  if (walk && event.pointerType === "touch") probe(event.offsetX, event.offsetY);
  pointers.set(event.pointerId, [event.clientX, event.clientY]);
  try { canvas.setPointerCapture(event.pointerId); } catch { /* a pointer that is gone is captured by nobody */ }
  canvas.focus();
});
canvas.addEventListener("pointermove", event => {
  const old = pointers.get(event.pointerId), now = [event.clientX, event.clientY];
  if (!old) return $("middle").checked ? undefined : probe(event.offsetX, event.offsetY);
  const [dx, dy] = sub(now, old);
  if (pointers.size === 2) {
    const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
    approach(Math.hypot(...sub(old, other)) / Math.max(1, Math.hypot(...sub(now, other))));
    shift(dx / 2, dy / 2);
  } else if (event.buttons & 2 || event.shiftKey) {
    shift(dx, dy);
  } else {
    turn(-dx * 0.005, -dy * 0.005);
  }
  pointers.set(event.pointerId, now);
  redraw();
});
for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, event => pointers.delete(event.pointerId));
canvas.addEventListener("pointerleave", () => $("middle").checked || unprobe());
canvas.addEventListener("contextmenu", event => event.preventDefault());
canvas.addEventListener("wheel", event => {
  event.preventDefault();
  approach(Math.exp(event.deltaY * 0.001));
  redraw();
}, { passive: false });
