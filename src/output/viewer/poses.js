
// Poses: where each body is at an opening. As viewers of glTF do it: turns between two keys by spherical linear
// interpolation, then each body in its parent's place.

function slerp(turns, a, b, t) {
  let product = 0;
  for (let i = 0; i < 4; ++i) product += turns[a + i] * turns[b + i];
  const sign = product < 0 ? -1 : 1;
  const angle = Math.acos(Math.min(1, Math.abs(product)));
  let p = 1 - t;
  let q = t * sign;
  if (angle > 1e-6) {
    p = Math.sin((1 - t) * angle) / Math.sin(angle);
    q = (sign * Math.sin(t * angle)) / Math.sin(angle);
  }
  return [0, 1, 2, 3].map((i) => p * turns[a + i] + q * turns[b + i]);
}

// The images of x, y and z, one after another.
function axesOf(quaternion) {
  const size = Math.hypot(...quaternion) || 1;
  const [x, y, z, w] = quaternion.map((value) => value / size);
  return [
    1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w),
    2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w),
    2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y),
  ];
}

function turned(axes, x, y, z) {
  return [0, 1, 2].map((i) => axes[i] * x + axes[3 + i] * y + axes[6 + i] * z);
}

function placeBodies(scene, degrees) {
  const angles = scene.angles;
  let high = 1;
  while (high < angles.length - 1 && angles[high] < degrees) ++high;
  const width = angles.length > 1 ? angles[high] - angles[high - 1] : 1;
  const t = angles.length > 1 ? Math.min(1, Math.max(0, (degrees - angles[high - 1]) / width)) : 0;
  for (const body of scene.bodies) {
    const own = body.turns.length > 4
      ? axesOf(slerp(body.turns, 4 * (high - 1), 4 * high, t))
      : axesOf(body.turns);
    const node = { axes: own, origin: body.offset };
    body.node = node;
    if (body.parent >= 0) {
      const base = scene.bodies[body.parent].node;
      node.axes = [0, 3, 6].flatMap((k) => turned(base.axes, own[k], own[k + 1], own[k + 2]));
      node.origin = turned(base.axes, ...body.offset).map((value, i) => value + base.origin[i]);
    }
    body.page.axes = node.axes;
    body.page.origin = turned(node.axes, -body.pivot[0], -body.pivot[1], 0)
      .map((value, i) => value + node.origin[i]);
    body.level = body.levels ? (1 - t) * body.levels[high - 1] + t * body.levels[high] : 0;
    body.collides = false;
  }
  for (const card of scene.cards) {
    const bodies = scene.bodies.slice(card.first, card.end);
    if (card.upright) turnBodies(bodies, kUpright);
    if (card.ground !== null) turnBodies(bodies, stageOn(scene.bodies[card.ground].node.axes));
    if (card.settles) settle(bodies);
    for (const { node } of bodies) node.origin = [node.origin[0] + card.shift, node.origin[1], node.origin[2]];
  }
  for (const one of scene.collisions) {
    if (degrees < one.from - 0.05 || degrees > one.to + 0.05) continue;
    scene.bodies[one.a].collides = true;
    scene.bodies[one.b].collides = true;
  }
}

// Moves each part that hangs together up or down until it stands on the ground, z = 0.
function settle(bodies) {
  const lowest = new Map();
  for (const body of bodies) {
    const low = bodyCorners(body).reduce((least, p) => Math.min(least, p[2]), Infinity);
    lowest.set(body.root, Math.min(low, lowest.get(body.root) ?? Infinity));
  }
  for (const { node, root } of bodies) node.origin = [node.origin[0], node.origin[1], node.origin[2] - lowest.get(root)];
}

// To the right, away and up, of a card whose spine stands.
const kUpright = [[1, 0, 0], [0, 0, -1], [0, 1, 0]];

// The same of a card whose page with these axes is the ground, and the other one a back wall.
function stageOn(ground) {
  return [ground.slice(3, 6), ground.slice(0, 3).map((value) => -value), ground.slice(6)];
}

// Turns all of a card so that these directions of its own are those of the scene.
function turnBodies(bodies, rows) {
  const turn = (v) => rows.map((row) => dot(row, v));
  for (const body of bodies) {
    const { axes, origin } = body.node;
    body.node = {
      axes: [0, 3, 6].flatMap((k) => turn([axes[k], axes[k + 1], axes[k + 2]])),
      origin: turn(origin),
    };
  }
}

const kClosedDeg = 2;
const kClosedLayerMm = 0.2;  // between plates of the closed card, at most
const kLayerMm = 0.1;  // between a plate and what is glued on it, where paper has no thickness
const kOneAboveMm = 0.04;  // between plates that are glued on one plate, perhaps over one another

const kOpenedDeg = 2;

// How far a body is drawn beside its place, so that what lies on one another is told apart: on a card that is as good as
// closed its layers, what lies on the pages of an open one, plates that are glued on the same one, and panels of folded
// sheets.
function apart(scene, body, degrees, paper) {
  const shift = body.above !== 0 ? apart(scene, scene.bodies[body.parent], degrees, paper) : [0, 0, 0];
  const move = (number, by) => {
    const axes = scene.bodies[number].node.axes;
    for (let i = 0; i < 3; ++i) shift[i] += by * axes[6 + i];
  };
  if (body.above !== 0) {
    const by = Math.max(kLayerMm, paper) + kOneAboveMm * (Math.abs(body.above) - 1);
    move(body.parent, Math.sign(body.above) * by);
  }
  if (body.level !== 0) {
    const { axes } = body.node;
    const by = Math.max(body.layerMm, paper) * body.level;
    for (let i = 0; i < 3; ++i) shift[i] += by * axes[6 + i];
  }
  if (body.lies >= 0) {
    const share = 1 - (scene.opening.to_deg - degrees) / kOpenedDeg;
    move(body.lies, Math.max(1, paper / kLayerMm) * body.open * Math.max(0, share));
  }
  if (body.cover >= 0 && body.layer !== undefined && degrees < kClosedDeg) {
    const thick = Math.max(1, paper / kClosedLayerMm);
    move(body.cover, thick * body.layer * (1 - degrees / kClosedDeg));
  }
  return shift;
}

function pointOf(body, x, y, z) {
  return turned(body.node.axes, x, y, z).map((value, i) => value + body.node.origin[i]);
}

function bodyCorners(body) {
  return [body.edges.cut, body.edges.fold, body.edges.line].flatMap((list) => {
    const corners = [];
    for (let i = 0; i < list.length; i += 3) corners.push(pointOf(body, list[i], list[i + 1], list[i + 2]));
    return corners;
  });
}

// Openings all over the sweep.
function openingsOf(scene) {
  if (!scene.opening) return [0];
  const { from_deg: from, to_deg: to } = scene.opening;
  return [0, 1, 2, 3, 4, 5, 6].map((i) => from + (i / 6) * (to - from));
}

// The corners of all bodies at openings all over the sweep: what a camera must have in view.
function cornersOf(scene) {
  const corners = openingsOf(scene).flatMap((degrees) => {
    placeBodies(scene, degrees);
    return scene.bodies.flatMap(bodyCorners);
  });
  return corners.length > 0 ? corners : [[0, 0, 0]];
}

const kCardGapMm = 20;

// Several cards stand side by side, where each is widest.
function layInARow(scene) {
  if (scene.cards.length < 2) return;
  const spans = scene.cards.map(() => [Infinity, -Infinity]);
  for (const degrees of openingsOf(scene)) {
    placeBodies(scene, degrees);
    scene.cards.forEach((card, number) => {
      const span = spans[number];
      for (const body of scene.bodies.slice(card.first, card.end)) {
        for (const [x] of bodyCorners(body)) {
          span[0] = Math.min(span[0], x);
          span[1] = Math.max(span[1], x);
        }
      }
    });
  }
  let left = 0;
  scene.cards.forEach((card, number) => {
    const [low, high] = spans[number];
    if (low > high) return;
    card.shift = left - low;
    left += high - low + kCardGapMm;
  });
}

// The body that a ray meets first, its distance along the ray; paper only.
function pick(scene, eye, direction) {
  let best = null;
  for (const body of scene.bodies) {
    const { axes, origin } = body.node;
    const from = [0, 1, 2].map((i) => eye[i] - origin[i] - body.shift[i]);
    const into = (v) => [0, 3, 6].map((k) => axes[k] * v[0] + axes[k + 1] * v[1] + axes[k + 2] * v[2]);
    const o = into(from);
    const d = into(direction);
    for (const mesh of body.meshes) {
      if (mesh.drawn) continue;
      const { at, triangles } = mesh;
      for (let i = 0; i < triangles.length; i += 3) {
        const distance = meet(o, d, at, 3 * triangles[i], 3 * triangles[i + 1], 3 * triangles[i + 2]);
        if (distance > 0 && (best === null || distance < best.distance)) best = { body, distance };
      }
    }
  }
  return best;
}

// Möller and Trumbore; no hit: −1.
function meet(o, d, at, a, b, c) {
  const e = [at[b] - at[a], at[b + 1] - at[a + 1], at[b + 2] - at[a + 2]];
  const f = [at[c] - at[a], at[c + 1] - at[a + 1], at[c + 2] - at[a + 2]];
  const p = cross(d, f);
  const det = dot(e, p);
  if (Math.abs(det) < 1e-12) return -1;
  const s = [o[0] - at[a], o[1] - at[a + 1], o[2] - at[a + 2]];
  const u = dot(s, p) / det;
  if (u < 0 || u > 1) return -1;
  const q = cross(s, e);
  const v = dot(d, q) / det;
  if (v < 0 || u + v > 1) return -1;
  return dot(f, q) / det;
}

function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}
