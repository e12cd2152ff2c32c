// What the form asks for is what is shown. The address behind "#" says the same, so that it can be kept and sent.
const byId = (id) => document.getElementById(id);
const list = byId('tiles');
const fields = ['words', 'element', 'finding', 'from', 'to', 'order'];
const plain = (text) => text.normalize('NFKC').toLowerCase();
const listed = (text) => (text ? text.split(' ') : []);
const tiles = [...list.children].map((item) => {
  const { elements, codes, worst, side, pieces } = item.dataset;
  return {
    item,
    text: plain(`${item.textContent} ${codes ?? ''}`),
    elements: listed(elements),
    codes: listed(codes),
    worst,
    side: side === undefined ? null : Number(side),
    pieces: Number(pieces ?? 0),
  };
});
let ordered = '';

function isFound(tile, finding) {
  if (!finding) return true;
  if (finding === 'none') return tile.worst === undefined || tile.worst === 'remark';
  if (finding === 'error') return tile.worst === 'error';
  if (finding === 'warning') return tile.worst === 'error' || tile.worst === 'warning';
  return tile.codes.includes(finding);
}

function isOfSize(tile, from, to) {
  if (!from && !to) return true;
  return tile.side !== null && tile.side >= Number(from || 0) && tile.side <= Number(to || Infinity);
}

function sort(order) {
  if (order === ordered) return;
  ordered = order;
  const rows = order ? [...tiles].sort((a, b) => (b[order] ?? 0) - (a[order] ?? 0)) : tiles;
  list.append(...rows.map((tile) => tile.item));
}

function show() {
  const asked = Object.fromEntries(fields.map((name) => [name, byId(name).value]));
  const words = plain(asked.words).split(/\s+/).filter((word) => word);
  let count = 0;
  for (const tile of tiles) {
    const fits = words.every((word) => tile.text.includes(word))
      && (!asked.element || tile.elements.includes(asked.element))
      && isFound(tile, asked.finding) && isOfSize(tile, asked.from, asked.to);
    tile.item.hidden = !fits;
    count += fits ? 1 : 0;
  }
  sort(asked.order);
  byId('none').hidden = count > 0;
  byId('shown').textContent = `${count} of ${tiles.length} shown`;
  return asked;
}

function showAndKeep() {
  const given = Object.entries(show()).filter(([, text]) => text);
  const hash = new URLSearchParams(given).toString();
  history.replaceState(null, '', hash ? `#${hash}` : location.pathname + location.search);
}

function read() {
  const asked = new URLSearchParams(location.hash.slice(1));
  for (const name of fields) {
    const field = byId(name);
    field.value = asked.get(name) ?? '';
    // A choice that this gallery does not have.
    if (field.selectedIndex < 0) field.selectedIndex = 0;
  }
  show();
}

const form = byId('filter');
form.hidden = false;
form.addEventListener('input', showAndKeep);
form.addEventListener('reset', () => setTimeout(showAndKeep));
form.addEventListener('submit', (event) => event.preventDefault());
form.addEventListener('keydown', (event) => {
  if (event.key !== 'Enter' || event.target.tagName !== 'INPUT') return;
  event.preventDefault();
  list.querySelector('li:not([hidden]) a')?.focus();
});
addEventListener('hashchange', read);
// Browsers fill forms of pages that one comes back to; the address knows better.
addEventListener('pageshow', read);
read();
