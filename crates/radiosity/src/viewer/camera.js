// ---- The camera: it looks at a target, from a distance, in a direction given by two angles about the axis that is up.
const up = record.asset.up;
const east = unit(cross(Math.abs(up[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0], up)), north = cross(up, east);
const views = record.cameras.length ? record.cameras : [framed];
const camera = {};
function viewFrom(given) {
  const eye = scale(sub(given.position, middle), 1 / radius), ahead = unit(given.direction);
  camera.yaw = Math.atan2(dot(ahead, east), dot(ahead, north));
  camera.pitch = Math.asin(Math.max(-1, Math.min(1, dot(ahead, up))));
  camera.distance = Math.max(0.1, -dot(eye, ahead));
  camera.target = add(eye, scale(ahead, camera.distance));
  camera.fov = given.vertical_fov;
  camera.aspect = given.aspect;
}
function firstView() {
  viewFrom(views[0]);
  camera.speed = 1;
  $("cameras").value = 0;
}
function turn(right, up) {
  camera.yaw += right;
  camera.pitch = Math.max(-1.57, Math.min(1.57, camera.pitch + up));
}
const approach = factor => { camera.distance *= factor; };
function axes() {
  const level = add(scale(east, Math.sin(camera.yaw)), scale(north, Math.cos(camera.yaw)));
  const ahead = add(scale(level, Math.cos(camera.pitch)), scale(up, Math.sin(camera.pitch)));
  const right = cross(level, up);
  return { ahead, right, above: cross(right, ahead), eye: sub(camera.target, scale(ahead, camera.distance)) };
}
// Half the picture's height at distance 1: as the camera has it or, where the canvas is narrower, so that its width fits.
const tangent = () => Math.tan(camera.fov / 2) * Math.max(1, camera.aspect * canvas.clientHeight / canvas.clientWidth);
// The box, the normal and the offset of every patch.
const hulls = new Float64Array(10 * record.patches.length);
record.patches.forEach((_, patch) => hulls.set([Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity], 10 * patch));
record.elements.forEach(([patch, ...corners]) => {
  const [a, b, c] = corners.map(corner => points[corner]), normal = cross(sub(b, a), sub(c, a)), at = 10 * patch;
  for (const axis of [0, 1, 2]) {
    hulls[at + axis] = Math.min(hulls[at + axis], a[axis], b[axis], c[axis]);
    hulls[at + 3 + axis] = Math.max(hulls[at + 3 + axis], a[axis], b[axis], c[axis]);
  }
  if (dot(normal, normal) > 0) hulls.set([...unit(normal), dot(unit(normal), a)], at + 6);
});
// No surface is nearer to the eye than this: each is as far as its box and its plane at least.
function clearance(eye) {
  let least = Infinity;
  for (let at = 0; at < hulls.length; at += 10) {
    let box = 0, plane = -hulls[at + 9];
    for (let axis = 0; axis < 3; axis++) {
      box += Math.max(hulls[at + axis] - eye[axis], eye[axis] - hulls[at + 3 + axis], 0) ** 2;
      plane += hulls[at + 6 + axis] * eye[axis];
    }
    least = Math.min(least, Math.max(Math.sqrt(box), Math.abs(plane)));
  }
  return least;
}
// The depth that drawing begins at. The nearer that is, the coarser are all depths, and what lies behind an edge shows through it.
function nearest() {
  const { eye } = axes(), t = tangent(), aspect = canvas.width / canvas.height;
  return Math.max(1e-3, Math.min(1, clearance(eye) / Math.hypot(1, t, t * aspect)));
}
function matrix() {
  const { ahead, right, above, eye } = axes();
  const aspect = canvas.width / canvas.height, t = tangent(), near = nearest(), far = camera.distance + 20;
  const rows = [scale(right, 1 / (t * aspect)), scale(above, 1 / t), scale(ahead, (far + near) / (far - near)), ahead];
  const shift = rows.map(row => -dot(row, eye));
  shift[2] -= 2 * far * near / (far - near);
  return new Float32Array([0, 1, 2].flatMap(axis => rows.map(row => row[axis])).concat(shift));
}
