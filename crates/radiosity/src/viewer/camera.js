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
function matrix() {
  const { ahead, right, above, eye } = axes();
  const aspect = canvas.width / canvas.height, t = tangent(), near = 1e-3, far = camera.distance + 20;
  const rows = [scale(right, 1 / (t * aspect)), scale(above, 1 / t), scale(ahead, (far + near) / (far - near)), ahead];
  const shift = rows.map(row => -dot(row, eye));
  shift[2] -= 2 * far * near / (far - near);
  return new Float32Array([0, 1, 2].flatMap(axis => rows.map(row => row[axis])).concat(shift));
}
