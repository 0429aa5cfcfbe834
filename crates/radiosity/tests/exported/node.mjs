// Files that three.js and glTF-Transform write. Run by make.py beside node_modules: node node.mjs SCENES FOLDER
import { readFileSync, writeFileSync } from "node:fs";
import { NodeIO } from "@gltf-transform/core";
import { ALL_EXTENSIONS } from "@gltf-transform/extensions";
import { meshopt, quantize } from "@gltf-transform/functions";
import { MeshoptDecoder, MeshoptEncoder } from "meshoptimizer";
import * as THREE from "three";
import { GLTFExporter } from "three/examples/jsm/exporters/GLTFExporter.js";
import { OBJExporter } from "three/examples/jsm/exporters/OBJExporter.js";
import { PLYExporter } from "three/examples/jsm/exporters/PLYExporter.js";
import { STLExporter } from "three/examples/jsm/exporters/STLExporter.js";

const [scenesPath, folder] = process.argv.slice(2);
const { room, ball } = JSON.parse(readFileSync(scenesPath, "utf8"));

// What browsers have and the exporters ask for.
globalThis.requestAnimationFrame = (done) => setTimeout(done);
globalThis.FileReader = class {
  readAsArrayBuffer(blob) {
    blob.arrayBuffer().then((buffer) => {
      this.result = buffer;
      this.onloadend();
    });
  }
};

function geometry(polygons) {
  const points = polygons.flatMap((polygon) => polygon.slice(1, -1).flatMap((_, i) => [polygon[0], polygon[i + 1], polygon[i + 2]]));
  const made = new THREE.BufferGeometry();
  made.setAttribute("position", new THREE.Float32BufferAttribute(points.flat(), 3));
  made.computeVertexNormals();
  return made;
}

function material(spec, side) {
  const made = new THREE.MeshStandardMaterial({ name: spec.name, metalness: 0, roughness: 1, side });
  made.color.setRGB(...spec.diffuse);
  if (spec.emission) {
    made.emissive.setRGB(...spec.emission);
    made.emissiveIntensity = spec.strength;
  }
  return made;
}

function scene(parts, side = THREE.FrontSide) {
  const made = new THREE.Scene();
  for (const part of parts) {
    const mesh = new THREE.Mesh(geometry(part.polygons), material(part.material, side));
    mesh.name = part.name;
    made.add(mesh);
  }
  return made;
}

const write = (name, data) => writeFileSync(`${folder}/${name}`, typeof data === "string" ? data : new Uint8Array(data.buffer ?? data));
const glb = (made) => new GLTFExporter().parseAsync(made, { binary: true });

const three = scene(room);
const camera = new THREE.PerspectiveCamera(50, 4 / 3, 0.1, 20);
camera.name = "camera";
camera.position.set(3.5, 0.5, 1.75);
camera.up.set(0, 0, 1);
camera.lookAt(1.5, 2, 1);
three.add(camera);
three.updateMatrixWorld(true);
write("three-room.glb", await glb(three));
write("three-room.obj", new OBJExporter().parse(scene(room)));
write("three-room.stl", new STLExporter().parse(scene(room), { binary: true }));
write("three-room.ply", new PLYExporter().parse(scene(room), undefined, { binary: true, littleEndian: false }));

const lit = scene(room.filter((part) => part.name !== "lamp"), THREE.DoubleSide);
for (const light of [new THREE.PointLight(0xffffff, 60), new THREE.SpotLight(0xffeecc, 80, 0, 0.6), new THREE.DirectionalLight(0xffffff, 2)]) {
  light.position.set(2, 1.5, 2.25);
  if (light.target) {
    light.target.position.set(0, 0, -1);
    light.add(light.target);
  }
  lit.add(light);
}
lit.updateMatrixWorld(true);
write("three-lights.glb", await glb(lit));

const many = new THREE.InstancedMesh(geometry(room[3].polygons), material(room[3].material), 3);
for (let i = 0; i < 3; i++) many.setMatrixAt(i, new THREE.Matrix4().makeTranslation(i, 0, 0));
const crates = new THREE.Scene();
crates.add(many, scene(room.slice(0, 3)));
crates.updateMatrixWorld(true);
write("three-instanced.glb", await glb(crates));

await MeshoptEncoder.ready;
const io = new NodeIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({ "meshopt.encoder": MeshoptEncoder, "meshopt.decoder": MeshoptDecoder });
const document = async (parts) => io.readBinary(new Uint8Array(await glb(scene(parts))));
const quantized = await document(ball);
await quantized.transform(quantize({ quantizePosition: 14 }));
write("transform-quantized.glb", await io.writeBinary(quantized));
const packed = await document(room);
await packed.transform(meshopt({ encoder: MeshoptEncoder, level: "high" }));
write("transform-meshopt.glb", await io.writeBinary(packed));
const text = await io.writeJSON(await document(room));
for (const buffer of text.json.buffers) {
  buffer.uri = "data:application/octet-stream;base64," + Buffer.from(text.resources[buffer.uri]).toString("base64");
}
write("transform-embedded.gltf", JSON.stringify(text.json));
