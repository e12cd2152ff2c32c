
// The page: what its buttons, its keys and a hand on the model do.

const byId = (id) => document.getElementById(id);
const scene = readScene(JSON.parse(byId('scene').textContent));
const camera = new Camera(cornersOf(scene), scene.views);
const canvas = byId('model');
let opening = scene.opening ? scene.opening.rest_deg : 0;
const paper = scene.paper || 0.3;  // mm
let painter = null;
let waiting = false;
let playing = null;

const shown = (degrees) => String(Math.round(degrees * 10) / 10);

function tell(text) {
  byId('told').textContent = text;
}

function redraw() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    if (!painter || painter.gl.isContextLost()) return;
    const scale = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(canvas.clientWidth * scale));
    const height = Math.max(1, Math.round(canvas.clientHeight * scale));
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    if (camera.aspect !== width / height) {
      camera.aspect = width / height;
      if (camera.fitted) camera.fit();
    }
    painter.draw(camera, opening, scale, byId('thick').checked ? paper : 0, byId('edges').checked);
    if (canvas.hidden) return;
    byId('still').hidden = true;
  });
}

function setOpening(degrees) {
  if (!scene.opening) return;
  const { from_deg: from, to_deg: to } = scene.opening;
  opening = Math.min(to, Math.max(from, degrees));
  placeBodies(scene, opening);
  const slider = byId('opening');
  slider.value = String(opening);
  slider.setAttribute('aria-valuetext', `${shown(opening)} degrees`);
  byId('degrees').textContent = `${shown(opening)}°`;
  canvas.setAttribute('aria-label', `The model, open at ${shown(opening)} degrees`);
  redraw();
}

function stop() {
  playing = null;
  byId('sign').textContent = '\u25b6';
  byId('play').setAttribute('aria-label', 'Play');
}

// To and fro, evenly, as long as it takes the animation of a model to open once.
function play() {
  if (playing) return stop();
  const { from_deg: from, to_deg: to, seconds } = scene.opening;
  playing = { way: opening >= to - 1e-6 ? -1 : 1, last: null };
  byId('sign').textContent = '\u275a\u275a';
  byId('play').setAttribute('aria-label', 'Pause');
  const step = (now) => {
    if (!playing) return;
    if (playing.last !== null) {
      let next = opening + (playing.way * (to - from) * Math.min(100, now - playing.last)) / (1000 * seconds);
      if (next >= to || next <= from) {
        playing.way = next >= to ? -1 : 1;
        next = Math.min(to, Math.max(from, next));
      }
      setOpening(next);
    }
    playing.last = now;
    requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}

function goTo(degrees) {
  stop();
  setOpening(degrees);
}

function lookFrom(view) {
  camera.look(view);
  redraw();
}

function reset() {
  stop();
  camera.look('iso');
  if (scene.opening) setOpening(scene.opening.rest_deg);
  redraw();
}

// ---- what is under the pointer

function bodyAt(clientX, clientY) {
  const box = canvas.getBoundingClientRect();
  if (box.width === 0 || box.height === 0) return null;
  camera.aspect = box.width / box.height;
  const x = (2 * (clientX - box.left)) / box.width - 1;
  const y = 1 - (2 * (clientY - box.top)) / box.height;
  const hit = pick(scene, camera.eye(), camera.ray(x, y));
  return hit ? hit.body : null;
}

let hovered = null;

function hover(body, clientX, clientY) {
  const label = byId('name');
  if (body !== hovered) {
    if (hovered) hovered.hovered = false;
    if (body) body.hovered = true;
    hovered = body;
    redraw();
  }
  label.hidden = !body;
  if (!body) return;
  label.textContent = body.name;
  const box = canvas.getBoundingClientRect();
  const left = Math.min(clientX - box.left + 14, box.width - label.offsetWidth - 4);
  const top = clientY - box.top + 18 + label.offsetHeight < box.height
    ? clientY - box.top + 18 : clientY - box.top - label.offsetHeight - 8;
  label.style.left = `${Math.max(4, left)}px`;
  label.style.top = `${Math.max(4, top)}px`;
}

// ---- a hand on the model

const held = new Map();
let hovering = null;

function onMove(event) {
  const old = held.get(event.pointerId);
  if (!old) {
    if (event.pointerType === 'touch') return;
    hovering = [event.clientX, event.clientY];
    requestAnimationFrame(() => {
      if (hovering) hover(bodyAt(...hovering), ...hovering);
      hovering = null;
    });
    return;
  }
  const size = canvas.clientHeight || 1;
  const before = [...held.values()];
  held.set(event.pointerId, { x: event.clientX, y: event.clientY, moves: old.moves });
  const after = [...held.values()];
  if (after.length === 1) {
    const dx = event.clientX - old.x;
    const dy = event.clientY - old.y;
    if (old.moves) camera.move(dx / size, dy / size);
    else camera.turn((-4 * dx) / size, (4 * dy) / size);
  } else if (after.length === 2) {
    const wide = ([a, b]) => Math.max(1, Math.hypot(a.x - b.x, a.y - b.y));
    const middle = ([a, b]) => [0.5 * (a.x + b.x), 0.5 * (a.y + b.y)];
    camera.zoom(wide(before) / wide(after));
    const [x, y] = middle(before);
    const [u, v] = middle(after);
    camera.move((u - x) / size, (v - y) / size);
  }
  redraw();
}

canvas.addEventListener('pointerdown', (event) => {
  canvas.setPointerCapture(event.pointerId);
  held.set(event.pointerId, { x: event.clientX, y: event.clientY, moves: event.button !== 0 || event.shiftKey });
  canvas.classList.add('held');
  hover(event.pointerType === 'touch' ? bodyAt(event.clientX, event.clientY) : null, event.clientX, event.clientY);
});
canvas.addEventListener('pointermove', onMove);
for (const kind of ['pointerup', 'pointercancel']) {
  canvas.addEventListener(kind, (event) => {
    held.delete(event.pointerId);
    if (held.size === 0) canvas.classList.remove('held');
  });
}
canvas.addEventListener('pointerleave', () => {
  hovering = null;
  if (held.size === 0) hover(null, 0, 0);
});
canvas.addEventListener('contextmenu', (event) => event.preventDefault());
canvas.addEventListener('wheel', (event) => {
  event.preventDefault();
  const lines = event.deltaMode === 1 ? 30 : 1;
  camera.zoom(Math.exp(Math.max(-300, Math.min(300, event.deltaY * lines)) * 0.0015));
  redraw();
}, { passive: false });

// ---- keys

const kTurns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const { key } = event;
  const inButton = event.target instanceof Element && event.target.closest('button, summary, a, [type=checkbox]');
  if (panelShown !== 'model' || (event.target instanceof Element && event.target.closest('[role=tab]'))) return;
  const inSlider = event.target === byId('opening');
  if (event.shiftKey && kTurns[key]) {
    const [x, y] = kTurns[key];
    camera.turn(0.1 * x, 0.1 * y);
    redraw();
  } else if (scene.opening && (key === 'ArrowLeft' || key === 'ArrowRight')) {
    const by = key === 'ArrowLeft' ? -1 : 1;
    goTo(Math.round(opening) + by);
  } else if (scene.opening && inSlider && (key === 'ArrowUp' || key === 'ArrowDown')) {
    goTo(Math.round(opening) + (key === 'ArrowDown' ? -1 : 1));
  } else if (scene.opening && key === ' ' && !inButton) {
    play();
  } else if (key === 'r' || key === 'R') {
    reset();
  } else if (key === '+' || key === '=' || key === '-') {
    camera.zoom(key === '-' ? 1.15 : 1 / 1.15);
    redraw();
  } else if (key >= '1' && key <= '6' && key.length === 1) {
    const button = document.querySelectorAll('#views button')[Number(key) - 1];
    lookFrom(button.dataset.view);
  } else {
    return;
  }
  event.preventDefault();
}
document.addEventListener('keydown', onKey);

for (const button of document.querySelectorAll('#views button')) {
  button.addEventListener('click', () => lookFrom(button.dataset.view));
}

for (const id of ['edges', 'thick']) byId(id).addEventListener('change', redraw);

// ---- tabs

const kPanels = ['model', 'sheets', 'findings'];
let panelShown = 'model';

function showPanel(name) {
  panelShown = name;
  for (const one of kPanels) {
    const tab = byId(`tab-${one}`);
    tab.setAttribute('aria-selected', String(one === name));
    tab.tabIndex = one === name ? 0 : -1;
    byId(`${one}-panel`).hidden = one !== name;
  }
  if (name === 'model') redraw();
  else stop();
  if (name === 'sheets') showSheets();
}

kPanels.forEach((name, number) => {
  const tab = byId(`tab-${name}`);
  tab.addEventListener('click', () => showPanel(name));
  tab.addEventListener('keydown', (event) => {
    const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!by) return;
    event.preventDefault();
    const next = kPanels[(number + by + kPanels.length) % kPanels.length];
    showPanel(next);
    byId(`tab-${next}`).focus();
  });
});

// Sheets are packed drawings, which are unpacked when they are looked at first.
async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).text();
}

async function showSheets() {
  for (const picture of document.querySelectorAll('#sheets-panel img:not([src])')) {
    const packed = scene.sheets[Number(picture.dataset.sheet)];
    try {
      picture.src = `data:image/svg+xml,${encodeURIComponent(await unpacked(packed))}`;
    } catch (problem) {
      picture.alt += ': this browser cannot unpack it';
    }
  }
}

// ---- opening, and where plates collide

function showCollisions() {
  const { from_deg: from, to_deg: to } = scene.opening;
  const list = byId('collisions');
  const count = scene.collisions.length;
  list.querySelector('summary').textContent = count === 1 ? '1 collision' : `${count} collisions`;
  const marks = new Map();
  for (const one of scene.collisions) {
    const names = `${scene.bodies[one.a].name} and ${scene.bodies[one.b].name}`;
    const text = `${names}: ${shown(one.from)}° to ${shown(one.to)}°, ${shown(one.depth)} mm`;
    const show = () => {
      goTo(one.deepest);
      tell(`${names} cross`);
    };
    const item = document.createElement('li');
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = text;
    button.addEventListener('click', show);
    item.append(button);
    list.querySelector('ul').append(item);
    const place = `${one.from} ${one.to}`;
    if (marks.has(place)) {
      marks.get(place).title += `\n${text}`;
      continue;
    }
    const mark = document.createElement('button');
    mark.type = 'button';
    mark.title = text;
    mark.style.left = `${(100 * (one.from - from)) / (to - from)}%`;
    mark.style.width = `${(100 * (one.to - one.from)) / (to - from)}%`;
    mark.setAttribute('aria-label', `Collision: ${text}`);
    mark.addEventListener('click', show);
    marks.set(place, mark);
    byId('marks').append(mark);
  }
  list.hidden = count === 0;
}

if (scene.opening) {
  const slider = byId('opening');
  slider.min = String(scene.opening.from_deg);
  slider.max = String(scene.opening.to_deg);
  slider.addEventListener('input', () => goTo(Number(slider.value)));
  byId('play').addEventListener('click', play);
  byId('controls').hidden = false;
  byId('moving').hidden = false;
  showCollisions();
}

// ---- beginning

function begin() {
  // Kept, so that it is there when the page is printed.
  const gl = canvas.getContext('webgl2', { antialias: true, stencil: true, alpha: true, preserveDrawingBuffer: true });
  if (!gl) {
    canvas.hidden = true;
    for (const id of ['controls', 'keys', 'views']) byId(id).hidden = true;
    byId('message').textContent = 'This browser has no WebGL 2, so this is a picture of the model.';
    byId('message').hidden = false;
    return;
  }
  for (const id of ['keys', 'views']) byId(id).hidden = false;
  byId('thick-label').hidden = !scene.bodies.some((body) => body.flat);
  painter = new Painter(gl, scene, redraw);
}
canvas.addEventListener('webglcontextlost', (event) => {
  event.preventDefault();
  painter = null;
});
canvas.addEventListener('webglcontextrestored', () => {
  begin();
  redraw();
});

// "#view=front&at=30" behind the address of the page: how it begins.
function followAddress() {
  const words = new URLSearchParams(location.hash.slice(1));
  if (Object.hasOwn(scene.views, words.get('view') || '')) camera.look(words.get('view'));
  const at = Number.parseFloat(words.get('at') || '');
  if (Number.isFinite(at)) goTo(at);
  redraw();
}
window.addEventListener('hashchange', followAddress);
new ResizeObserver(redraw).observe(canvas);
window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);

document.documentElement.classList.add('scripted');
showPanel('model');
byId('thick').checked = scene.paper > 0;
canvas.hidden = false;
placeBodies(scene, opening);
begin();
setOpening(opening);
followAddress();

// For tests and for other scripts: what stands where. Nothing of it changes more than the controls do.
window.popupc = Object.freeze({
  names: () => scene.bodies.map((body) => body.name),
  opening: () => opening,
  setOpening: goTo,
  look: lookFrom,
  // Of a plate: the frame that maps points of its pattern page into the world of its card, in mm, where both pages rise
  // alike, whatever way the card is shown.
  frameOf: (name) => {
    const body = scene.bodies.find((one) => one.name === name);
    return body ? { axes: [...body.page.axes], origin: [...body.page.origin] } : null;
  },
  collides: (name) => scene.bodies.some((one) => one.name === name && one.collides),
  nameAt: (x, y) => (bodyAt(x, y) || { name: null }).name,
});
