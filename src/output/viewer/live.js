
// The live view: asks the server of the page for what is new, and puts it in place of what is shown. What the
// reader has set stays: viewpoint, opening, tab and switches.

const kHiddenPause = 60000;  // ms between two questions of a page that nobody sees
const kMostFailures = 4;
const kPicturePause = 1000;  // ms that a picture may take to be there before the card is shown without it

let version = 0;  // of what is shown; 0: nothing yet
let hasModel = false;

// ---- painters follow one another on one context: what is the same is kept, what is not used any more is
// given back

const livePrograms = new Map();
const livePictures = new Map();  // by address
let liveRest = [];               // what only the painter in use has

const compileProgram = makeProgram;
makeProgram = (gl, texts) => {
    if (!livePrograms.has(texts)) livePrograms.set(texts, compileProgram(gl, texts));
    return livePrograms.get(texts);
};

const loadPicture = Painter.prototype.load;
Painter.prototype.load = function load(address, ready) {
    if (!livePictures.has(address)) {
        let there = null;
        const loaded = new Promise((done) => {
            there = done;
        });
        const picture = loadPicture.call(this, address, () => {
            there();
            ready();
        });
        livePictures.set(address, {
            ...picture,
            get there() {
                return picture.there;
            },
            loaded
        });
    }
    return livePictures.get(address);
};

const drawThin = Painter.prototype.draw;
Painter.prototype.draw = function draw(from, degrees, scale, thick, edges) {
    drawThin.call(this, from, degrees, scale, thick > 0 ? scene.paper || 0.3 : 0, edges);
};

canvas.addEventListener('webglcontextlost', () => {
    livePrograms.clear();
    livePictures.clear();
    liveRest = [];
});

// A painter of this scene, and all it has made.
function newPainter(gl, fresh) {
    const made = [];
    const kinds = ['Buffer', 'VertexArray', 'Texture'];
    for (const kind of kinds) {
        gl[`create${kind}`] = () => {
            const one = WebGL2RenderingContext.prototype[`create${kind}`].call(gl);
            made.push([kind, one]);
            return one;
        };
    }
    try {
        const next = new Painter(gl, fresh, redraw);
        const kept = new Set([...livePictures.values()].map((picture) => picture.texture));
        return [next, made.filter(([, one]) => !kept.has(one))];
    } finally {
        for (const kind of kinds) delete gl[`create${kind}`];
    }
}

function usePainter(next, made) {
    const {gl} = next;
    for (const [kind, one] of liveRest) gl[`delete${kind}`](one);
    liveRest = made;
    for (const [address, picture] of livePictures) {
        if (scene.pictures.includes(address)) continue;
        gl.deleteTexture(picture.texture);
        livePictures.delete(address);
    }
    next.scene = scene;
    painter = next;
}

// ---- what is new, in place of what was

// The corners of the convex hull of points x, y, 0 in a row.
function hullOf(list) {
    const all = [];
    for (let i = 0; i < list.length; i += 3) all.push([list[i], list[i + 1]]);
    all.sort(([ax, ay], [bx, by]) => ax - bx || ay - by);
    const side = (p, q, r) => (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    const chain = (points) => points.reduce((kept, point) => {
        while (kept.length > 1 && side(kept[kept.length - 2], kept[kept.length - 1], point) <= 0) kept.pop();
        kept.push(point);
        return kept;
    }, []);
    return [...chain(all), ...chain(all.reverse())].flatMap(([x, y]) => [x, y, 0]);
}

// What decides how far the camera stands off: of a flat body its hull, which is as large as the body from all
// sides.
function hulls() {
    const bodies = scene.bodies.map((body) => {
        if (!body.flat) return body;
        const {cut, fold, line} = body.edges;
        return {...body, edges: {cut: hullOf([...cut, ...fold, ...line]), fold: [], line: []}};
    });
    return {...scene, bodies};
}

// The camera stays where it is, or, where nobody has moved it, as near as all of the card can be seen.
function frameScene() {
    class Extent extends Camera {
        look() {}
    }
    const {corners, views, middle, ground, box, radius} = new Extent(cornersOf(hulls()), scene.views);
    Object.assign(camera, {corners, views, middle, ground, box, radius});
    if (camera.fitted) camera.fit();
}

function showOpening(degrees) {
    const moves = Boolean(scene.opening);
    for (const id of ['controls', 'moving']) byId(id).hidden = !moves;
    byId('collisions').querySelector('ul').replaceChildren();
    byId('collisions').hidden = true;
    byId('marks').replaceChildren();
    const way = playing ? playing.way : 0;
    stop();
    if (!moves) {
        placeBodies(scene, 0);
        canvas.setAttribute('aria-label', 'The model');
        return;
    }
    byId('opening').min = String(scene.opening.from_deg);
    byId('opening').max = String(scene.opening.to_deg);
    showCollisions();
    setOpening(degrees);
    if (way !== 0) {
        play();
        playing.way = way;
    }
}

async function showModel(model) {
    const fresh = readScene(model.scene);
    fresh.sheets = scene.sheets;
    let next = null;
    let made = [];
    if (painter) {
        const {gl} = painter;
        [next, made] = newPainter(gl, fresh);
        const pictures = fresh.pictures.map((address) => livePictures.get(address).loaded);
        if (pictures.length > 0) {
            await Promise.race(
                [Promise.all(pictures), new Promise((done) => setTimeout(done, kPicturePause))]);
        }
    }
    hover(null, 0, 0);
    Object.assign(scene, fresh);
    frameScene();
    // The context may have been lost meanwhile.
    if (next && painter) usePainter(next, made);
    byId('thick-label').hidden = !scene.bodies.some((body) => body.flat);
    if (!hasModel) {
        byId('thick').checked = scene.paper > 0;
        opening = scene.opening ? scene.opening.rest_deg : 0;
    }
    showOpening(opening);
    if (!hasModel) followAddress();
    hasModel = true;
    document.querySelector('h1').textContent = model.title;
    redraw();
}

// Where sheets are being looked at they stay until the new ones can be shown.
async function showNewSheets(sheets) {
    scene.sheets = sheets.packed;
    byId('tab-sheets').textContent = `Sheets (${sheets.count})`;
    const next = document.createElement('template');
    next.innerHTML = `<h2>Sheets</h2>${sheets.html}`;
    if (panelShown === 'sheets') {
        for (const picture of next.content.querySelectorAll('img')) {
            const drawing = await unpacked(sheets.packed[Number(picture.dataset.sheet)]);
            picture.src = `data:image/svg+xml,${encodeURIComponent(drawing)}`;
            await picture.decode().catch(() => {});
        }
    }
    byId('sheets-panel').replaceChildren(next.content);
}

function showTrouble(news) {
    const trouble = byId('trouble');
    let text = news.errors === 1 ? '1 error' : `${news.errors} errors`;
    if (news.stale) text += hasModel ? '. The last good picture is shown.' : '. There is no picture yet.';
    trouble.querySelector('h2').textContent = text;
    trouble.querySelector('div').innerHTML = news.trouble;
    trouble.hidden = news.errors === 0;
    document.documentElement.classList.toggle('stale', news.stale);
    byId('tab-findings').textContent = `Findings (${news.finding_count})`;
    byId('findings-panel').innerHTML = `<h2>Findings</h2>${news.findings}`;
    document.title = `${news.errors > 0 ? '\u26a0 ' : ''}${document.querySelector('h1').textContent}`;
}

async function show(news) {
    if (news.model) await showModel(news.model);
    if (news.sheets) await showNewSheets(news.sheets);
    showTrouble(news);
    version = news.version;
    const told = () => {
        document.documentElement.dataset.version = String(version);
    };
    if (document.hidden)
        told();
    else
        requestAnimationFrame(told);
}

// ---- asking

let leave = null;
let wake = null;

const pause = (ms) => new Promise((done) => {
    const timer = setTimeout(done, ms);
    wake = () => {
        clearTimeout(timer);
        done();
    };
});

// A page that nobody sees gives its connection up, of which browsers have few.
document.addEventListener('visibilitychange', () => {
    if (document.hidden && leave)
        leave.abort();
    else if (wake)
        wake();
});

// What is newer than what is shown: `next` waits for it, `now` does not. Null: nothing.
async function ask(word) {
    leave = new AbortController();
    const {signal} = leave;
    const reply = await fetch(`${word}?after=${version}`, {cache: 'no-store', credentials: 'omit', signal});
    if (!reply.ok) throw new Error(`status ${reply.status}`);
    return reply.status === 204 ? null : reply.json();
}

async function follow() {
    for (let failures = 0; failures < kMostFailures;) {
        let news = null;
        try {
            news = await ask(document.hidden ? 'now' : 'next');
            failures = 0;
            byId('link').hidden = true;
        } catch (problem) {
            if (!leave.signal.aborted) await pause(100 * 4 ** failures++);
        }
        if (news && news.over) return;
        if (news)
            await show(news);
        else if (document.hidden)
            await pause(kHiddenPause);
    }
}

async function live() {
    for (;;) {
        await follow();
        byId('link').textContent = 'popupc view has ended. What is shown here does not change any more.';
        byId('link').hidden = false;
        // Perhaps it was this computer that slept.
        await new Promise((done) => {
            wake = done;
        });
    }
}

if (painter) {
    for (const [name, texts] of Object.entries(kPrograms)) livePrograms.set(texts, painter.programs[name]);
} else {
    byId('message').textContent =
        'This browser has no WebGL 2, so the model cannot be shown. Sheets and findings are.';
}
new ResizeObserver(() => {
    byId('trouble').style.bottom = `${byId('panel').offsetHeight + 12}px`;
}).observe(byId('panel'));
live();

window.popupcLive = Object.freeze({
    version: () => version,
    viewpoint: () =>
        ({yaw: camera.yaw, pitch: camera.pitch, distance: camera.distance, target: [...camera.target]}),
});
