// The ribs in space: turned with the pointer, picked with a click, coloured by what is chosen. One view per element `.view`, which holds
// the network as JSON (`network.json`). A row of a table that names a rib picks it, and a picked rib marks its rows.
import {
  AmbientLight,
  Box3,
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  DoubleSide,
  Mesh,
  MeshLambertMaterial,
  PerspectiveCamera,
  Raycaster,
  Scene,
  ShapeUtils,
  Sphere,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

// Utilisation from unused to full; nothing known; picked.
const SCALE = ["#3b6fb6", "#4aa3a1", "#8fbf5a", "#e0b84a", "#c8442e"].map((hex) => new Color(hex));
const UNKNOWN = new Color("#9a9a9a");
const PICKED = new Color("#d81b9a");
// Twelve colours that are told apart (after Paul Tol's schemes), for names.
const NAMED = "#4477aa #ee6677 #228833 #ccbb44 #66ccee #aa3377 #ee8866 #44bb99 #bbcc33 #aaaa00 #77aadd #997700"
  .split(" ")
  .map((hex) => new Color(hex));

function scaled(share) {
  const at = Math.min(Math.max(share, 0), 1) * (SCALE.length - 1);
  const low = Math.min(Math.floor(at), SCALE.length - 2);
  return SCALE[low].clone().lerp(SCALE[low + 1], at - low);
}

// Names in the order of how often they occur, so that the most frequent have colours of their own.
function palette(names) {
  const counts = new Map();
  for (const name of names) counts.set(name, (counts.get(name) ?? 0) + 1);
  const order = [...counts.keys()].sort((a, b) => counts.get(b) - counts.get(a));
  return new Map(order.map((name, at) => [name, name === "" ? UNKNOWN : NAMED[at % NAMED.length]]));
}

// Two triangles per side of each ring, and caps where a section is one ring or an outer ring with holes.
function surface(network) {
  const caps = network.outlines.map(([outer, ...holes]) => {
    const points = (ring) => ring.map(([x, y]) => new Vector2(x, y));
    return ShapeUtils.triangulateShape(points(outer), holes.map(points));
  });
  const positions = [];
  const owners = [];
  const point = (rib, end, [across, up]) =>
    [0, 1, 2].map((axis) => rib.ends[end][axis] + rib.y[axis] * across + rib.z[axis] * up);
  const triangle = (owner, ...corners) => {
    for (const corner of corners) positions.push(...corner);
    owners.push(owner);
  };
  network.ribs.forEach((rib, owner) => {
    const [first, last] = rib.outlines.map((at) => network.outlines[at]);
    first.forEach((ring, r) => {
      const [near, far] = [first, last].map((rings, end) => rings[r].map((corner) => point(rib, end, corner)));
      ring.forEach((_, k) => {
        const next = (k + 1) % ring.length;
        triangle(owner, near[k], near[next], far[next]);
        triangle(owner, near[k], far[next], far[k]);
      });
    });
    for (const [end, rings] of [[0, first], [1, last]]) {
      const corners = rings.flat().map((corner) => point(rib, end, corner));
      for (const [a, b, c] of caps[rib.outlines[end]]) triangle(owner, corners[a], corners[b], corners[c]);
    }
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute("color", new BufferAttribute(new Float32Array(positions.length), 3));
  geometry.computeVertexNormals();
  geometry.computeBoundingBox();
  geometry.computeBoundingSphere();
  return { geometry, owners };
}

function show(root) {
  const network = JSON.parse(root.querySelector("script").textContent);
  const canvas = root.querySelector("canvas");
  const told = root.querySelector("output");
  const choice = root.querySelector("select");
  let renderer;
  try {
    renderer = new WebGLRenderer({ canvas, alpha: true, antialias: true, preserveDrawingBuffer: true });
  } catch {
    root.classList.add("without");
    told.textContent = "This browser shows nothing in space (WebGL is off); the picture below does.";
    return;
  }
  const { geometry, owners } = surface(network);
  const mesh = new Mesh(geometry, new MeshLambertMaterial({ vertexColors: true, side: DoubleSide, flatShading: true }));
  const scene = new Scene();
  scene.add(mesh, new AmbientLight(0xffffff, 1.6));
  const light = new DirectionalLight(0xffffff, 2);
  scene.add(light);
  const camera = new PerspectiveCamera(35, 1, 0.01, 100);
  camera.up.set(0, 0, 1);
  const controls = new OrbitControls(camera, canvas);
  const sphere = geometry.boundingSphere ?? new Sphere(new Vector3(), 1);
  const box = geometry.boundingBox ?? new Box3(new Vector3(), new Vector3());

  const draw = () => {
    light.position.copy(camera.position).add(new Vector3(0, 0, sphere.radius));
    renderer.render(scene, camera);
  };
  // From a direction, as near as shows every corner of the box around everything.
  let direction = new Vector3(1, 1, 0.8);
  const look = (from) => {
    direction = from.clone().normalize();
    const right = new Vector3().crossVectors(camera.up, direction).normalize();
    const up = new Vector3().crossVectors(direction, right);
    const [steep, flat] = [Math.tan(((camera.fov / 2) * Math.PI) / 180), camera.aspect];
    let distance = 1e-6;
    for (const x of [box.min.x, box.max.x]) {
      for (const y of [box.min.y, box.max.y]) {
        for (const z of [box.min.z, box.max.z]) {
          const corner = new Vector3(x, y, z).sub(sphere.center);
          const aside = Math.max(Math.abs(corner.dot(up)), Math.abs(corner.dot(right)) / flat) / steep;
          distance = Math.max(distance, corner.dot(direction) + 1.08 * aside);
        }
      }
    }
    controls.target.copy(sphere.center);
    camera.position.copy(sphere.center).addScaledVector(direction, distance);
    camera.near = distance / 1000;
    camera.far = distance * 10 + 4 * sphere.radius;
    camera.updateProjectionMatrix();
    controls.update();
    draw();
  };

  // Colours.
  const limits = palette(network.ribs.map((rib) => rib.limit));
  const sections = palette(network.ribs.map((rib) => rib.section));
  const schemes = {
    utilisation: (rib) => (rib.share === null ? UNKNOWN : scaled(rib.share)),
    limit: (rib) => limits.get(rib.limit),
    section: (rib) => sections.get(rib.section),
  };
  let picked = -1;
  const paint = () => {
    const colours = geometry.attributes.color;
    const own = network.ribs.map(schemes[choice.value]);
    owners.forEach((owner, at) => {
      const colour = owner === picked ? PICKED : own[owner];
      for (let corner = 0; corner < 3; corner++) colours.setXYZ(3 * at + corner, colour.r, colour.g, colour.b);
    });
    colours.needsUpdate = true;
    legend();
    draw();
  };
  const legend = () => {
    const list = root.querySelector(".legend");
    const entries =
      choice.value === "utilisation"
        ? [0, 0.25, 0.5, 0.75, 1].map((share) => [`${100 * share} %`, scaled(share)])
        : [...(choice.value === "limit" ? limits : sections)].slice(0, NAMED.length).map(([name, colour]) => [name || "none", colour]);
    list.replaceChildren(
      ...entries.map(([name, colour]) => {
        const item = document.createElement("li");
        const mark = document.createElement("i");
        mark.style.background = `#${colour.getHexString()}`;
        item.append(mark, name);
        return item;
      }),
    );
  };

  // Picking, and the rows of tables.
  const article = root.closest("article") ?? document;
  const numbers = new Map(network.ribs.map((rib, at) => [rib.name, at]));
  const rows = (name) => [...article.querySelectorAll("tr[data-rib]")].filter((row) => row.dataset.rib === name);
  const pick = (at, scroll) => {
    for (const row of article.querySelectorAll("tr.picked")) row.classList.remove("picked");
    picked = at;
    const rib = network.ribs[at];
    told.textContent = rib
      ? `${rib.name}: section ${rib.section}` +
        (rib.share === null ? "" : `, used ${(100 * rib.share).toFixed(1)} %`) +
        (rib.limit ? ` by ${rib.limit}` : "")
      : "";
    const marked = rib ? rows(rib.name) : [];
    for (const row of marked) row.classList.add("picked");
    if (scroll && marked.length > 0) marked[0].closest(".wide")?.scrollIntoView({ block: "nearest" });
    paint();
  };
  const caster = new Raycaster();
  let pressed = null;
  canvas.addEventListener("pointerdown", (event) => (pressed = [event.clientX, event.clientY]));
  canvas.addEventListener("pointerup", (event) => {
    const moved = pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]);
    if (moved === null || moved > 4) return;
    const box = canvas.getBoundingClientRect();
    const place = new Vector2(
      (2 * (event.clientX - box.left)) / box.width - 1,
      1 - (2 * (event.clientY - box.top)) / box.height,
    );
    caster.setFromCamera(place, camera);
    const [hit] = caster.intersectObject(mesh);
    pick(hit ? owners[hit.faceIndex] : -1, false);
  });
  article.addEventListener("click", (event) => {
    const row = event.target.closest?.("tr[data-rib]");
    const at = row ? numbers.get(row.dataset.rib) : undefined;
    if (at !== undefined) pick(at, false);
  });

  choice.addEventListener("change", paint);
  const ways = { space: [1, 1, 0.8], top: [0, -1e-3, 1], front: [0, -1, 0], side: [1, 0, 0] };
  for (const button of root.querySelectorAll("button[data-way]")) {
    button.addEventListener("click", () => look(new Vector3(...ways[button.dataset.way])));
  }
  controls.addEventListener("change", draw);
  const fit = () => {
    const { clientWidth, clientHeight } = canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    renderer.setSize(clientWidth, clientHeight, false);
    camera.aspect = clientWidth / clientHeight;
    look(direction);
  };
  new ResizeObserver(fit).observe(canvas);
  fit();
  paint();
  root.dataset.ready = String(network.ribs.length);
}

for (const root of document.querySelectorAll(".view")) show(root);
