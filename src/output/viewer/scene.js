
// The scene: what the page's block of data says, as arrays that can be drawn. src/output/viewer/scene_json.h has
// what stands there. Lengths are mm, z is up, the gutter runs along y.

const kDigits = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/';
const kDigitOf = new Map([...kDigits].map((digit, value) => [digit, value]));

// Numbers of a text: five bits a digit, the sixth says that more follow, the lowest of all is the sign; each number is
// told by how much it differs from the one `stride` before.
function numbers(text, stride) {
  const values = [];
  let sum = 0;
  let unit = 1;
  for (const letter of text) {
    const digit = kDigitOf.get(letter);
    sum += (digit & 31) * unit;
    unit *= 32;
    if (digit & 32) continue;
    const size = Math.floor(sum / 2);
    const before = values.length < stride ? 0 : values[values.length - stride];
    values.push(before + (sum % 2 ? -size : size));
    sum = 0;
    unit = 1;
  }
  return values;
}

const kPointMm = 1e-2;
const kTurn = 5e-6;

// Each number and all those 4, 8 … places before.
function summed(values, stride) {
  for (let i = stride; i < values.length; ++i) values[i] += values[i - stride];
  return values;
}

function points(text, size) {
  return numbers(text, size).map((value) => value * kPointMm);
}

function rgb(text) {
  return [1, 3, 5].map((at) => parseInt(text.slice(at, at + 2), 16));
}

// A plate that moves, or a piece that stands. Its meshes are where `at` says: points of three numbers.
function readBody(row, flat, lists) {
  const list = (number) => (number === undefined ? '' : lists[number]);
  const spread = (number) => {
    if (!flat) return points(list(number), 3);
    const two = points(list(number), 2);
    const three = [];
    for (let i = 0; i < two.length; i += 2) three.push(two[i], two[i + 1], 0);
    return three;
  };
  const meshes = (row.meshes || []).map((mesh) => {
    const at = spread(mesh.points);
    let places = null;
    if (mesh.picture !== undefined) {
      places = [];
      if (flat) {
        const [ux, uy, u0, vx, vy, v0] = mesh.place;
        for (let i = 0; i < at.length; i += 3) {
          places.push(ux * at[i] + uy * at[i + 1] + u0, vx * at[i] + vy * at[i + 1] + v0);
        }
      } else {
        places = numbers(list(mesh.places), 2).map((value) => value * 1e-6);
      }
    }
    if (flat) for (let i = 2; i < at.length; i += 3) at[i] = mesh.lift || 0;
    return {
      at,
      places,
      picture: mesh.picture,
      color: rgb(mesh.color || '#ffffff'),
      back: rgb(mesh.back || mesh.color || '#ffffff'),
      drawn: Boolean(mesh.drawn || mesh.lift),
      triangles: numbers(list(mesh.triangles), 1),
    };
  });
  return {
    name: row.name,
    flat,
    parent: -1,
    offset: row.offset || [0, 0, 0],
    pivot: row.pivot || [0, 0],
    turns: row.turns !== undefined ? summed(numbers(list(row.turns), 4), 4).map((value) => value * kTurn) : [0, 0, 0, 1],
    layer: row.layer,
    levels: row.levels === undefined ? null : numbers(list(row.levels), 1).map((value) => value / 100),
    level: 0,
    shift: [0, 0, 0],  // that it is drawn beside its place
    layerMm: 0,
    above: row.above || 0,
    lies: -1,  // on this body's front when the card is open, `open` mm above it
    open: row.open || 0,
    meshes,
    edges: { cut: spread(row.cuts), fold: spread(row.folds), line: spread(row.lines) },
    collides: false,
    hovered: false,
    page: { axes: [1, 0, 0, 0, 1, 0, 0, 0, 1], origin: [0, 0, 0] },
    node: { axes: [1, 0, 0, 0, 1, 0, 0, 0, 1], origin: [0, 0, 0] },
  };
}

function readScene(data) {
  const scene = {
    opening: data.opening || null,
    angles: data.angles || [],
    pictures: data.pictures || [],
    sheets: data.sheets || [],
    bodies: [],
    collisions: [],
    views: data.views,
    cards: [],  // bodies from `first` up to `end`; `ground`: the one on which a stage stands, or null; `shift` along x
    paper: data.paper_mm || 0,
    covers: [],  // of each card that has layers when it is closed: its first cover
  };
  for (const card of data.cards) {
    const first = scene.bodies.length;
    for (const row of card.plates || []) {
      const body = readBody(row, true, data.lists);
      if (row.parent !== undefined) body.parent = first + row.parent;
      body.root = body.parent >= 0 ? scene.bodies[body.parent].root : scene.bodies.length;
      if (row.page !== undefined) body.lies = first + row.page;
      body.cover = card.cover === undefined ? -1 : first + card.cover;
      body.layerMm = card.layer_mm || 0;
      scene.bodies.push(body);
    }
    for (const row of card.standing || []) {
      const body = readBody(row, false, data.lists);
      body.cover = -1;
      scene.bodies.push(body);
    }
    scene.cards.push({
      first,
      end: scene.bodies.length,
      ground: card.ground === undefined ? null : first + card.ground,
      upright: card.upright === true,
      settles: card.settles === true,
      shift: 0,
    });
    for (const row of card.collisions || []) {
      scene.collisions.push({
        a: first + row.plates[0],
        b: first + row.plates[1],
        from: row.from_deg,
        to: row.to_deg,
        deepest: row.deepest_deg,
        depth: row.depth_mm,
      });
    }
  }
  layInARow(scene);
  return scene;
}
