// ---- Lines over the surfaces: who shoots, and links.
const LINE_VERTEX = `#version 300 es
layout(location = 0) in vec3 position;
uniform mat4 view;
uniform float near;
void main() {
  gl_Position = view * vec4(position, 1.0);
  // Two thousandths nearer than the surfaces that the lines lie on.
  gl_Position.z -= 4e-3 * near;
}`;
const LINE_FRAGMENT = `#version 300 es
precision highp float;
uniform vec4 tone;
out vec4 colour;
void main() { colour = vec4(tone.rgb * tone.a, tone.a); }`;
const linesProgram = link(LINE_VERTEX, LINE_FRAGMENT), linesState = gl.createVertexArray(), linesBuffer = gl.createBuffer();
const [linesView, linesNear, linesTone] = ["view", "near", "tone"].map(name => gl.getUniformLocation(linesProgram, name));
function overlay(kind, places, tone) {
  if (places.length === 0) return;
  gl.useProgram(linesProgram);
  gl.bindVertexArray(linesState);
  gl.bindBuffer(gl.ARRAY_BUFFER, linesBuffer);
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(places.flat()), gl.DYNAMIC_DRAW);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
  gl.uniformMatrix4fv(linesView, false, matrix());
  gl.uniform1f(linesNear, nearest());
  gl.uniform4fv(linesTone, tone);
  gl.enable(gl.BLEND);
  gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  gl.drawArrays(kind, 0, places.length);
  gl.disable(gl.BLEND);
  gl.bindVertexArray(null);
}
