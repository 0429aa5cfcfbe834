// ---- WebGL: surfaces, with whatever is shown of them as attributes of their corners.
const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
if (!gl) {
  $("probe").textContent = "this browser has no WebGL 2: no light can be shown";
  throw new Error("no WebGL 2");
}

const VERTEX = `#version 300 es
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 interpolated;
layout(location = 2) in vec3 element;
layout(location = 3) in vec3 patch_mean;
layout(location = 4) in vec3 emitted;
layout(location = 5) in vec3 received;
layout(location = 6) in vec2 place;
layout(location = 7) in vec3 open;
layout(location = 8) in vec3 estimated;
layout(location = 9) in vec2 amounts;
uniform mat4 view;
uniform int show;
out vec3 light, lamp, fall, corner;
out vec2 at;
out float amount;
void main() {
  gl_Position = view * vec4(position, 1.0);
  amount = show == 5 ? amounts.x : amounts.y;
  light = show == 0 ? interpolated : show == 1 ? element : show == 2 ? patch_mean : show == 3 ? open : estimated;
  lamp = emitted;
  fall = received;
  at = place;
  corner = vec3(gl_VertexID % 3 == 0, gl_VertexID % 3 == 1, gl_VertexID % 3 == 2);
}`;
const FRAGMENT = `#version 300 es
precision highp float;
in vec3 light, lamp, fall, corner;
in vec2 at;
in float amount;
uniform float k, most;
uniform vec3 tones[5];
uniform bool wireframe, lights, textured, raw, plain, measured, back;
uniform sampler2D picture;
out vec4 colour;
void main() {
  vec3 b = textured ? fall * texture(picture, at).rgb + lamp : light;
  if (!lights && !raw) b = max(b - lamp, 0.0);
  // As pictures are exposed: the largest part decides, the others keep their shares of it.
  float brightest = max(max(b.r, b.g), max(b.b, 1e-30));
  vec3 intensity = (1.0 - exp(-k * brightest)) * max(b, 0.0) / brightest;
  vec3 srgb = mix(12.92 * intensity, 1.055 * pow(intensity, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, intensity));
  if (plain) srgb = light;
  if (measured) {
    float place = 4.0 * clamp(amount / most, 0.0, 0.9999);
    int tone = int(place);
    srgb = mix(tones[tone], tones[tone + 1], place - float(tone));
  }
  // Backs are hatched: no light is known of them.
  if (back) srgb = vec3(mod(gl_FragCoord.x + gl_FragCoord.y, 12.0) < 6.0 ? 0.25 : 0.3);
  if (wireframe) {
    vec3 near = corner / fwidth(corner);
    float line = 1.0 - smoothstep(0.0, 1.0, min(near.x, min(near.y, near.z)));
    srgb = mix(srgb, vec3(0.2, 0.7, 1.0), line);
  }
  colour = vec4(srgb, 1.0);
}`;

function compile(kind, text) {
  const shader = gl.createShader(kind);
  gl.shaderSource(shader, text);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
  return shader;
}

function link(vertex, fragment) {
  const program = gl.createProgram();
  gl.attachShader(program, compile(gl.VERTEX_SHADER, vertex));
  gl.attachShader(program, compile(gl.FRAGMENT_SHADER, fragment));
  gl.linkProgram(program);
  return program;
}
const program = link(VERTEX, FRAGMENT);
const uniform = Object.fromEntries(
  ["view", "show", "k", "wireframe", "lights", "textured", "raw", "plain", "measured", "back", "most", "tones"].map(name => [name, gl.getUniformLocation(program, name)]));

// One attribute: for every corner of every element a row of `width` numbers.
const buffers = [];
function attribute(location, width, row) {
  const numbers = new Float32Array(order.length * 3 * width);
  order.forEach((element, place) => {
    const corners = shown.elements[element];
    for (let corner = 0; corner < 3; corner++) numbers.set(row(element, corners[corner + 1]), (3 * place + corner) * width);
  });
  gl.bindBuffer(gl.ARRAY_BUFFER, buffers[location] ??= gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.DYNAMIC_DRAW);
  gl.enableVertexAttribArray(location);
  gl.vertexAttribPointer(location, width, gl.FLOAT, false, 0, 0);
}
// What the mean irradiance of each patch may be off by, as a share of itself or of 1 % of the scene's mean, in its worst band.
const estimated = record.patches.length > 0 && record.patches.every(patch => patch.estimate?.length);
const sum = values => values.reduce((sum, value) => sum + value, 0);
const everywhere = record.bound.map((_, band) =>
  sum(record.patches.map(patch => patch.area * patch.irradiance[band])) / sum(record.patches.map(patch => patch.area)));
const errorShare = patch => Math.max(...patch.estimate.map((error, band) =>
  error === 0 ? 0 : error / Math.max(patch.irradiance[band], 0.01 * everywhere[band])));
// From 0.1 % to 10 %, evenly in the logarithm; a little darker where the surface is turned away, so that edges are seen.
const TONES = [[0.27, 0.0, 0.33], [0.23, 0.32, 0.55], [0.13, 0.57, 0.55], [0.37, 0.79, 0.38], [0.99, 0.91, 0.14]];
function errorColour(element) {
  const [of, a, b, c] = shown.elements[element];
  const at = 2 * Math.max(0, Math.min(1.999, 3 + Math.log10(errorShare(record.patches[of])) || 0)), tone = Math.floor(at);
  const normal = cross(sub(shown.points[b], shown.points[a]), sub(shown.points[c], shown.points[a]));
  const shade = 0.75 + 0.25 * Math.abs(dot(unit(normal), [0.36, 0.48, 0.8]));
  return add(scale(TONES[tone], shade * (tone + 1 - at)), scale(TONES[tone + 1], shade * (at - tone)));
}

// What an eye makes of red, green and blue (Rec. 709): the height of a grey that looks as bright.
const luminous = ([red, green, blue]) => 0.2126 * red + 0.7152 * green + 0.0722 * blue;

// Shows a mesh with its light. What depends on the mesh alone is kept while that stays.
function show(stage) {
  const same = order.length > 0 && stage.elements === shown.elements;
  shown = stage;
  if (!same) {
    order = shown.elements.map((_, element) => element).sort((a, b) => picture(a) - picture(b) || a - b);
    // Runs of elements with the same picture.
    runs = [];
    order.forEach((element, place) => {
      const last = runs[runs.length - 1];
      if (last && last.picture === picture(element)) last.count += 3;
      else runs.push({ picture: picture(element), first: 3 * place, count: 3 });
    });
    attribute(0, 3, (_, vertex) => shown.points[vertex]);
    attribute(4, 3, element => emitted[patch(element)]);
    attribute(6, 2, (_, vertex) => shown.place(vertex));
    if (estimated) attribute(8, 3, errorColour);
  }
  attribute(1, 3, (element, vertex) => shown.vertex(vertex));
  attribute(2, 3, element => shown.element(element));
  attribute(3, 3, element => shown.patch(patch(element)));
  attribute(5, 3, (element, vertex) => shown.received(patch(element), vertex));
  attribute(7, 3, element => shown.open(element));
  attribute(9, 2, (element, vertex) => [luminous(shown.vertex(vertex)), luminous(shown.irradiance(element, vertex))]);
}

const pictures = record.pictures.map(address => {
  const texture = gl.createTexture(), image = new Image();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, 1, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array([188, 188, 188, 255]));
  image.onload = () => {
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, gl.RGBA, gl.UNSIGNED_BYTE, image);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    gl.generateMipmap(gl.TEXTURE_2D);
    redraw();
  };
  image.src = address;
  return texture;
});
