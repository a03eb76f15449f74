// A frame of a GLB by a renderer that runs in Chromium, timed, for `petrichor bench --compare`:
//
//     node browser.mjs PAGE.html SCENE.glb WIDTH HEIGHT REPEAT OUT.png REPORT.json
//
// The page (three.html, filament.html) defines prepare(glb, width, height) and frame(), which draws and returns the
// pixels as RGBA bytes, bottom row first. Modules are those of $PEERS/node_modules. CPU time is that of all
// processes of the browser; the picture is read back before the clock stops.
import fs from 'node:fs';
import http from 'node:http';
import { createRequire } from 'node:module';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const [page, glb, width, height, repeat, picture, report] = process.argv.slice(2);
const modules = path.join(process.env.PEERS, 'node_modules');
const require = createRequire(path.join(process.env.PEERS, 'peers.js'));
const { default: puppeteer } = await import(pathToFileURL(require.resolve('puppeteer-core')));

const name = path.basename(page, '.html');
const { version } = JSON.parse(fs.readFileSync(path.join(modules, name, 'package.json')));

const kinds = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm' };
const server = http.createServer((request, response) => {
  const asked = decodeURIComponent(new URL(request.url, 'http://here').pathname);
  const file = asked === '/scene.glb' ? glb
    : asked === '/' ? page
    : path.join(modules, path.normalize(asked));
  if (asked === '/favicon.ico') return response.writeHead(204).end();
  fs.readFile(file, (error, bytes) => {
    response.writeHead(error ? 404 : 200, { 'content-type': kinds[path.extname(file)] ?? 'application/octet-stream' });
    response.end(bytes);
  });
});
await new Promise((ready) => server.listen(0, '127.0.0.1', ready));

const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM, headless: true, protocolTimeout: 0,
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
});
let failed = '';

// Clock ticks of the browser's process and all below it, in milliseconds.
function cpu() {
  const parents = new Map(), ticks = new Map();
  for (const name of fs.readdirSync('/proc')) {
    if (!/^\d+$/.test(name)) continue;
    try {
      const fields = fs.readFileSync(`/proc/${name}/stat`, 'latin1').replace(/^.*\) /s, '').split(' ');
      parents.set(+name, +fields[1]);
      ticks.set(+name, +fields[11] + +fields[12]);
    } catch { /* it has ended */ }
  }
  const root = browser.process().pid;
  let sum = 0;
  for (const [process, own] of ticks) {
    let up = process;
    while (up && up !== root) up = parents.get(up);
    if (up === root) sum += own;
  }
  return sum * 10;
}

try {
  const tab = await browser.newPage();
  tab.on('pageerror', (error) => { failed ||= error.message; });
  tab.on('console', (said) => { if (said.type() === 'error') failed ||= said.text(); });
  await tab.goto(`http://127.0.0.1:${server.address().port}/`);
  await tab.waitForFunction('globalThis.prepare !== undefined', { timeout: 60000 });
  await tab.evaluate((w, h) => prepare('/scene.glb', w, h), +width, +height);
  const times = { cpu: [], wall: [] };
  for (let turn = 0; turn <= +repeat; ++turn) { // the first compiles and uploads
    const before = cpu(), clock = performance.now();
    await tab.evaluate(async () => { globalThis.pixels = await frame(); });
    if (turn === 0) continue;
    times.wall.push(performance.now() - clock);
    times.cpu.push(cpu() - before);
  }
  const png = await tab.evaluate((w, h) => {
    const canvas = new OffscreenCanvas(w, h), upright = new Uint8ClampedArray(w * h * 4);
    for (let y = 0; y < h; ++y) upright.set(pixels.subarray((h - 1 - y) * w * 4, (h - y) * w * 4), y * w * 4);
    for (let i = 3; i < upright.length; i += 4) upright[i] = 255;
    canvas.getContext('2d').putImageData(new ImageData(upright, w, h), 0, 0);
    return canvas.convertToBlob({ type: 'image/png' }).then((blob) => blob.arrayBuffer()).then((bytes) => {
      let text = '';
      for (const byte of new Uint8Array(bytes)) text += String.fromCharCode(byte);
      return btoa(text);
    });
  }, +width, +height);
  fs.writeFileSync(picture, Buffer.from(png, 'base64'));
  fs.writeFileSync(report, JSON.stringify({ version, cpu_ms: times.cpu, wall_ms: times.wall }));
} catch (error) {
  console.error(error.message + (failed ? ' (' + failed + ')' : ''));
  process.exitCode = 1;
} finally {
  await browser.close();
  server.close();
}
