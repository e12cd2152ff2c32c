// Opens a page in Chromium without a window and asks it questions, through a pipe:
//   node drive_page.mjs CHROMIUM PROFILE PAGE PICTURE WIDTH HEIGHT SCHEME [EXPRESSION ...]
// PROFILE is an empty folder for the browser; PAGE is a file, or an address that begins with http; PICTURE takes a PNG of
// the page as it stands after the last expression, or what is printed of it if it ends with .pdf ("-": none); SCHEME is
// light or dark, and after a comma no-webgl or no-script for a browser without. Expressions are JavaScript, or "@FILE" for
// all of a file's; promises are waited for.
// "press KEY" presses a key (Tab, Enter, Shift+Tab, ArrowDown, a letter) and "type TEXT" types a text, where the focus
// is, as a hand would. "$ COMMAND" is done by sh, and gives what it prints. Prints
// {messages: [what the page wrote to the console, and what the browser says of it], values: [one an expression]}.
// Exit 3 where the browser does not start. It needs nothing but Node 18 or newer.
import { execFileSync, spawn } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [chromium, profile, page, picture, width, height, looks, ...expressions] = process.argv.slice(2);
const [scheme, lacking] = looks.split(',');
const browser = spawn(chromium, [
  '--headless', '--no-sandbox', '--disable-gpu', '--use-gl=angle', '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader', '--disable-quic', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-sync', `--user-data-dir=${profile}`, '--remote-debugging-pipe',
  `--window-size=${width},${height}`, ...(lacking === 'no-webgl' ? ['--disable-3d-apis'] : []), 'about:blank',
], { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });

const give = (code) => {
  browser.removeAllListeners('exit');
  browser.once('exit', () => process.exit(code));
  browser.kill('SIGKILL');
};
browser.once('error', () => process.exit(3));
browser.once('exit', () => process.exit(3));
setTimeout(() => {
  console.error('the page takes longer than 100 seconds');
  give(1);
}, 100000);

let number = 0;
let rest = Buffer.alloc(0);
const waiting = new Map();
const messages = [];
const heard = new Map();

function send(method, params = {}, session = undefined) {
  const id = ++number;
  browser.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId: session })}\0`);
  return new Promise((resolve, reject) => waiting.set(id, { resolve, reject, method }));
}
function once(event) {
  return new Promise((resolve) => heard.set(event, resolve));
}
function take(message) {
  if (message.id !== undefined) {
    const { resolve, reject, method } = waiting.get(message.id);
    waiting.delete(message.id);
    if (message.error) reject(new Error(`${method}: ${message.error.message}`));
    else resolve(message.result);
    return;
  }
  const { params } = message;
  if (message.method === 'Runtime.consoleAPICalled') {
    messages.push(`${params.type}: ${params.args.map((one) => one.value ?? one.description).join(' ')}`);
  } else if (message.method === 'Runtime.exceptionThrown') {
    messages.push(`exception: ${params.exceptionDetails.exception?.description ?? params.exceptionDetails.text}`);
  } else if (message.method === 'Log.entryAdded') {
    messages.push(`${params.entry.level}: ${params.entry.text}`);
  }
  heard.get(message.method)?.(params);
}
browser.stdio[4].on('data', (chunk) => {
  rest = Buffer.concat([rest, chunk]);
  for (let end = rest.indexOf(0); end >= 0; end = rest.indexOf(0)) {
    take(JSON.parse(rest.subarray(0, end).toString('utf8')));
    rest = rest.subarray(end + 1);
  }
});

async function drive() {
  const { targetId } = await send('Target.createTarget', { url: 'about:blank' });
  const { sessionId } = await send('Target.attachToTarget', { targetId, flatten: true });
  const ask = (method, params) => send(method, params, sessionId);
  await ask('Emulation.setDeviceMetricsOverride',
    { width: Number(width), height: Number(height), deviceScaleFactor: 1, mobile: false });
  await ask('Emulation.setEmulatedMedia', { features: [{ name: 'prefers-color-scheme', value: scheme }] });
  await ask('Page.enable');
  await ask('Runtime.enable');
  await ask('Log.enable');
  if (lacking === 'no-script') await ask('Emulation.setScriptExecutionDisabled', { value: true });
  const loaded = once('Page.loadEventFired');
  const hash = page.indexOf('#');
  const file = hash < 0 ? page : page.slice(0, hash);
  const url = file.startsWith('http') ? file : pathToFileURL(file).href;
  await ask('Page.navigate', { url: url + (hash < 0 ? '' : page.slice(hash)) });
  await loaded;
  const press = async (asked) => {
    const shift = asked.startsWith('Shift+');
    const key = shift ? asked.slice(6) : asked;
    const codes = { Tab: 9, Enter: 13, Escape: 27, ' ': 32, Home: 36, End: 35, ArrowUp: 38, ArrowDown: 40 };
    const event = { key, code: key, windowsVirtualKeyCode: codes[key] ?? key.toUpperCase().charCodeAt(0), modifiers: shift ? 8 : 0 };
    const text = { Enter: '\r', ' ': ' ' }[key] ?? (key.length === 1 ? key : undefined);
    await ask('Input.dispatchKeyEvent', { type: text ? 'keyDown' : 'rawKeyDown', text, ...event });
    await ask('Input.dispatchKeyEvent', { type: 'keyUp', ...event });
    return key;
  };
  const evaluate = async (asked) => {
    if (asked.startsWith('press ')) return press(asked.slice(6));
    if (asked.startsWith('type ')) return ask('Input.insertText', { text: asked.slice(5) }).then(() => null);
    const expression = asked.startsWith('@') ? `${readFileSync(asked.slice(1))}; 0` : asked;
    const { result, exceptionDetails } = await ask('Runtime.evaluate',
      { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(`${asked}: ${exceptionDetails.exception?.description}`);
    return result.value ?? null;
  };
  const drawn = 'new Promise((r) => requestAnimationFrame(() => requestAnimationFrame(() => r(0))))';
  if (lacking !== 'no-script') await evaluate(drawn);
  const values = [];
  for (const expression of expressions) {
    if (expression.startsWith('$ ')) values.push(execFileSync('sh', ['-c', expression.slice(2)], { encoding: 'utf8' }));
    else values.push(await evaluate(expression));
  }
  if (lacking !== 'no-script') await evaluate(drawn);
  if (picture.endsWith('.pdf')) {
    const printed = await ask('Page.printToPDF', {});
    writeFileSync(picture, Buffer.from(printed.data, 'base64'));
  } else if (picture !== '-') {
    const shot = await ask('Page.captureScreenshot', { format: 'png' });
    writeFileSync(picture, Buffer.from(shot.data, 'base64'));
  }
  process.stdout.write(`${JSON.stringify({ messages, values })}\n`, () => give(0));
}
drive().catch((error) => {
  console.error(error.message);
  give(1);
});
