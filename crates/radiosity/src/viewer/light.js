"use strict";
// The light, the mesh that it is on, and the vectors that both are made of.
const LIGHT = /*LIGHT*/null;
const { record, shares, k: K, view: framed } = LIGHT;
const $ = id => document.getElementById(id);
const canvas = $("canvas");

// ---- Small vectors.
const add = (a, b) => a.map((x, i) => x + b[i]);
const scale = (a, s) => a.map(x => x * s);
const sub = (a, b) => a.map((x, i) => x - b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = a => scale(a, 1 / Math.hypot(...a));

// ---- The mesh: positions relative to the middle of the scene, in units of its radius, as single precision wants it.
const low = [0, 1, 2].map(axis => record.vertices.reduce((least, v) => Math.min(least, v[axis]), Infinity));
const high = [0, 1, 2].map(axis => record.vertices.reduce((most, v) => Math.max(most, v[axis]), -Infinity));
const middle = scale(add(low, high), 0.5);
const radius = Math.hypot(...sub(high, low)) / 2 || 1;
const points = record.vertices.map(v => scale(sub(v, middle), 1 / radius));
// Red, green and blue of a row of bands, each of which has a share in them.
const rgb = (values, row) => shares.reduce((sum, share, band) => add(sum, scale(share, values[row * record.bands + band])), [0, 0, 0]);
const emitted = record.patches.map(patch => scale(rgb(patch.emission, 0), Math.PI));
// What is shown: the solution, or a step of the run that led to it. `open` is what is yet to be shot.
const solution = {
  points, elements: record.elements,
  vertex: vertex => rgb(record.vertex_radiosity, vertex),
  element: element => rgb(record.radiosity, element),
  patch: patch => rgb(record.patches[patch].radiosity, 0),
  received: (patch, vertex) => rgb(record.vertex_irradiance, vertex).map((band, i) => band * record.patches[patch].tint[i]),
  irradiance: (_, vertex) => rgb(record.vertex_irradiance, vertex),
  place: vertex => record.places[vertex] ?? [0, 0],
  open: () => [0, 0, 0],
};
let shown = solution;
const patch = element => shown.elements[element][0];
// Elements by picture, so that each picture is bound once; −1 for none.
const picture = element => record.patches[patch(element)].picture ?? -1;
let order = [], runs = [];
