// ---- The run, step by step.
const bytes = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0)).buffer;
// Rows of red, green and blue: signed roots of shares of the largest, in 16 bits.
function colours(packed) {
  const roots = new Int16Array(bytes(packed.values));
  return Float32Array.from(roots, root => packed.peak * (root / 32767) * Math.abs(root / 32767));
}
const rows = (numbers, width) => Array.from({ length: numbers.length / width }, (_, i) => [...numbers.subarray(i * width, (i + 1) * width)]);
const place = point => scale(sub(point, middle), 1 / radius);

function walking(recording) {
  const { steps, every, seen } = recording, last = steps.length - 1;
  const meshes = [], stages = new Map();
  let at = last, timer = 0, pointed = null;
  const mesh = index => index === null ? solution : meshes[index] ??= {
    points: rows(new Float64Array(bytes(recording.meshes[index].vertices)), 3).map(place),
    elements: rows(new Uint32Array(bytes(recording.meshes[index].elements)), 4),
  };
  const corners = rows(new Float64Array(bytes(recording.tiles.corners)), 3).map(place);
  let first = 0;
  const tiles = [...new Uint32Array(bytes(recording.tiles.sizes))].map(size => {
    const own = corners.slice(first, first += size);
    const normal = unit(own.map((corner, i) => cross(corner, own[(i + 1) % size])).reduce(add));
    return { corners: own, normal, middle: scale(own.reduce(add), 1 / size) };
  });
  const has = (tile, { point, ray }) => dot(tile.normal, ray) < 0
    && Math.abs(dot(tile.normal, sub(point, tile.corners[0]))) < 1e-5
    && tile.corners.every((corner, i) =>
      dot(tile.normal, cross(sub(tile.corners[(i + 1) % tile.corners.length], corner), sub(point, corner))) > -1e-7);

  // The light of a step: at vertices and on patches the mean over their elements.
  function stage(index) {
    if (index === last) return solution;
    if (stages.has(index)) return stages.get(index);
    const step = steps[index], { points, elements } = mesh(step.mesh);
    const reflected = colours(step.light), open = step.open && colours(step.open);
    const own = element => add([0, 1, 2].map(i => reflected[3 * element + i]), emitted[elements[element][0]]);
    const means = count => ({ sums: new Float64Array(3 * count), areas: new Float64Array(count) });
    const vertices = means(points.length), patches = means(record.patches.length);
    const put = ({ sums, areas }, to, area, light) => {
      areas[to] += area;
      light.forEach((band, i) => { sums[3 * to + i] += area * band; });
    };
    elements.forEach(([patch, ...corners], element) => {
      const [a, b, c] = corners.map(corner => points[corner]), light = own(element);
      const area = Math.hypot(...cross(sub(b, a), sub(c, a)));
      put(patches, patch, area, light);
      corners.forEach(corner => put(vertices, corner, area, light));
    });
    const mean = ({ sums, areas }, of) => [0, 1, 2].map(i => sums[3 * of + i] / (areas[of] || 1));
    const made = {
      points, elements, element: own,
      vertex: vertex => mean(vertices, vertex), patch: patch => mean(patches, patch),
      received: () => [0, 0, 0], irradiance: () => [0, 0, 0], place: solution.place,
      open: element => open ? [0, 1, 2].map(i => Math.max(0, open[3 * element + i])) : [0, 0, 0],
    };
    if (stages.size > 8) stages.delete(stages.keys().next().value);
    stages.set(index, made);
    return made;
  }

  const many = (count, one) => `${count} ${one}${count === 1 ? "" : "s"}`;
  function story(index) {
    const { kind, count, mesh, shooter, link_count } = steps[index], { elements } = stage(index);
    const links = link_count ? `, ${many(link_count, "link")} between tiles` : "";
    if (kind === "solution") return `the solution${links}`;
    if (kind === "rounds") return count ? `after round ${count}: ${many(elements.length, "element")}${links}` : "before the first round: emitted light only, no links";
    if (kind === "bounces") return count ? `after ${many(count, "reflection")}` : "emitted light only";
    const pass = recording.meshes.length ? `pass ${(mesh ?? recording.meshes.length) + 1} of ${recording.meshes.length + 1}, ` : "";
    const by = shooter && shooter[0] < shooter[1] ? `; next shoots ${record.patches[elements[shooter[0]][0]].name} (${many(shooter[1] - shooter[0], "element")})` : "";
    return `${pass}after ${many(count, "shot")}${by}`;
  }
  function ledger(step) {
    const whole = sum(recording.emitted) || 1;
    const parts = ["absorbed", "escaped", "unshot"].map(name => [name, 100 * sum(step[name]) / whole]);
    $("ledger").replaceChildren(...parts.map(([name, share]) => {
      const part = document.createElement("div");
      part.className = name;
      part.style.width = `${Math.max(0, share)}%`;
      return part;
    }));
    $("shares").replaceChildren("of the emitted power", ...parts.flatMap(([name, share]) => {
      const [chip, both] = [document.createElement("span"), document.createElement("span")];
      chip.className = `chip ${name}`;
      both.append(chip, `${name} ${Math.abs(share) < 0.05 ? 0 : share.toFixed(1)} %`);
      return [" ", both];
    }));
    $("ledger").setAttribute("aria-label", $("shares").textContent);
  }
  function go(index) {
    at = Math.max(0, Math.min(last, index));
    $("step").value = at;
    $("story").textContent = `${at + 1} / ${steps.length}: ${story(at)}`;
    ledger(steps[at]);
    show(stage(at));
    redraw();
  }
  function play(on) {
    clearInterval(timer);
    timer = 0;
    if (on) {
      if (at === last) go(0);
      timer = setInterval(() => { at < last ? go(at + 1) : play(false); }, Math.max(60, Math.min(800, 12000 / steps.length)));
    }
    $("play").textContent = timer ? "stop" : "play";
  }
  // The place that links are shown of: the one pointed at last, else what is in the middle.
  function linkedAt(links) {
    const target = pointed ?? hit(canvas.clientWidth / 2, canvas.clientHeight / 2);
    if (target.element < 0) return { ends: [], links: [] };
    const here = new Set();
    tiles.forEach((tile, index) => { if (has(tile, target)) here.add(index); });
    const own = links.filter(ends => ends.some(end => here.has(end)));
    return { ends: [...new Set(own.flat().filter(end => here.has(end)))], links: own };
  }
  function overlays() {
    const step = steps[at], { points, elements } = shown;
    if (step.shooter && at < last) {
      const own = elements.slice(...step.shooter), edges = new Map();
      own.forEach(([, ...corners]) => corners.forEach((from, i) => {
        const ends = [from, corners[(i + 1) % 3]], key = [...ends].sort((a, b) => a - b).join();
        edges.has(key) ? edges.delete(key) : edges.set(key, ends);
      }));
      overlay(gl.TRIANGLES, own.flatMap(([, ...corners]) => corners.map(corner => points[corner])), [1, 0.5, 0, 0.3]);
      const outline = [...edges.values()].flat().map(corner => points[corner]);
      overlay(gl.LINES, outline, [1, 0.6, 0.1, 1]);
      // What hides it, hides it half.
      gl.disable(gl.DEPTH_TEST);
      overlay(gl.LINES, outline, [1, 0.6, 0.1, 0.4]);
      gl.enable(gl.DEPTH_TEST);
    }
    const choice = $("links").value;
    if (tiles.length === 0 || choice === "none") return;
    const all = rows(new Uint32Array(bytes(step.links)), 2);
    const { ends, links } = choice === "all" ? { ends: [], links: all } : linkedAt(all);
    const dense = Math.max(0.04, Math.min(0.8, 60 / Math.sqrt(links.length + 1) / 8));
    overlay(gl.LINES, links.flatMap(pair => pair.map(end => tiles[end].middle)), [0.3, 0.9, 1, dense]);
    const sides = ends.flatMap(end => tiles[end].corners.flatMap((corner, i, own) => [corner, own[(i + 1) % own.length]]));
    overlay(gl.LINES, sides, [1, 0.6, 0.1, 1]);
  }

  $("walk").hidden = $("walk-keys").hidden = false;
  $("link-choice").hidden = tiles.length === 0;
  const unshot = document.querySelector("#show option[value=unshot]");
  unshot.hidden = unshot.disabled = !unshotKnown();
  $("step").max = last;
  const fewer = steps.some(step => step.link_count > Math.ceil(step.links.length * 3 / 4 / 8));
  $("thinned").textContent = [
    every > 1 ? `Of ${seen} steps, ${recording.first > 1 ? `the first ${recording.first} are kept and then` : ""} one in ${every}.` : "",
    fewer ? "Of many links, some are kept, evenly picked." : "",
  ].join(" ").trim();
  $("thinned").hidden = !$("thinned").textContent;
  $("step").addEventListener("input", () => go(Number($("step").value)));
  $("back").addEventListener("click", () => go(at - 1));
  $("on").addEventListener("click", () => go(at + 1));
  $("play").addEventListener("click", () => play(!timer));
  $("links").addEventListener("input", redraw);
  return {
    go, overlays, toggle: () => play(!timer), at: () => at, last,
    point: (x, y) => { pointed = hit(x, y); if (tiles.length) redraw(); },
  };
}
