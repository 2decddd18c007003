// The whole laboratory as one file, dist/quadtank.html, made of the site in dist/. It opens by double click and in
// <iframe sandbox="allow-scripts">, where nothing beside it can be loaded; so all of it is inside, and a policy names
// each part by its hash.
import { existsSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { fail, hashOf, replaceOnce } from './html.mjs';

const SITE = 'dist';
const FILE = `${SITE}/quadtank.html`;

const read = (name) => readFileSync(`${SITE}/${name}`, 'utf8');
const base64 = (name) => readFileSync(`${SITE}/${name}`).toString('base64');

/** The JavaScript of wasm-bindgen without its exports: one module has nobody to export to. */
function withoutExports(glue) {
  const plain = glue.replace(/^export (?=(?:async )?(?:function|class|const) )/gm, '').replace(/^export \{[^}]*\};?\s*$/gm, '');
  const left = plain.match(/^\s*(?:export|import)\b.*$/m);
  if (left) fail(`the JavaScript of the site still has "${left[0].trim()}"; the single file cannot take that`);
  return plain;
}

/** The start script of the site, which says what went wrong, with the wasm at hand instead of fetched. */
function startWithBytes(start) {
  const fetching = /const \{ js, wasm \} = [^;]*;\s*const laboratory = await import\([^;]*;\s*await laboratory\.default\([^;]*;/;
  const inPlace =
    "const bytes = Uint8Array.from(atob(document.getElementById('wasm').textContent), (c) => c.charCodeAt(0));\n" +
    '    await __wbg_init({ module_or_path: bytes });';
  // In a block of its own, so that its names do not meet those of the glue.
  return `{\n${replaceOnce(start, fetching, () => inPlace)}}\n`;
}

/** Text that cannot end the element around it. */
const inside = (element, text) => text.replace(new RegExp(`</(?=${element})`, 'gi'), '<\\/');

if (existsSync(`${SITE}/snippets`)) fail('dist/snippets exists: a dependency brings JavaScript that is not inlined yet');

const page = read('index.html');
const [, js, wasm] = page.match(/<script\b[^>]*\sdata-js="([^"]+)"[^>]*\sdata-wasm="([^"]+)"/) ?? fail('dist/index.html starts no wasm');

const glue = withoutExports(read(js));
const script = inside('script', `${glue}\n${startWithBytes(read('start.js'))}`);
const sheets = [...page.matchAll(/<link\b[^>]*\brel="stylesheet"[^>]*\bhref="([^"]+)"[^>]*>/g)];
const style = inside('style', sheets.map(([, href]) => read(href)).join('\n'));
if (/url\(|@import/.test(style)) fail('the style sheets load something; the single file cannot');

/** The lessons, which the site loads one by one. */
const lessons = readdirSync(`${SITE}/lessons`)
  .sort()
  .map((name) => `<script type="application/json" id="lesson-${name.slice(3, -5)}">${read(`lessons/${name}`).replaceAll('<', '\\u003c')}</script>`)
  .join('');

const policy = [
  "default-src 'none'",
  `script-src ${hashOf(script)} 'wasm-unsafe-eval'`,
  `style-src ${hashOf(style)}`,
  'img-src data: blob:',
  "frame-src 'self'",
  "base-uri 'none'",
  "form-action 'none'",
].join('; ');

let single = page.replace(/<link\b[^>]*\brel="(?:modulepreload|preload|stylesheet|manifest)"[^>]*>\s*/g, '');
single = replaceOnce(single, /<html(?=[\s>])/, () => '<html data-single');
single = replaceOnce(single, /(?<=http-equiv="Content-Security-Policy" content=")[^"]*/, () => policy);
single = replaceOnce(single, /(<link\b[^>]*\brel="icon"[^>]*\bhref=")([^"]+)/, (_, before, icon) => `${before}data:image/svg+xml;base64,${base64(icon)}`);
single = replaceOnce(single, /<script\b[^>]*\sdata-wasm=[^>]*><\/script>/, () => '');
single = replaceOnce(single, /<\/head>/, (end) => `<style>${style}</style>${end}`);
single = replaceOnce(
  single,
  /<\/body>/,
  (end) => `${lessons}<script type="text/plain" id="wasm">${base64(wasm)}</script><script type="module">${script}</script>${end}`,
);

const loaded = single.replace(/<(script|style)\b[^>]*>[^]*?<\/\1>/g, '').match(/<(?:link|script|img)\b[^>]*\b(?:href|src)="(?!data:)[^"]*"/);
if (loaded) fail(`the single file would load ${loaded[0]}`);
writeFileSync(FILE, single);
console.log(`build: the single file is ${FILE} (${Math.round(single.length / 1000)} KB)`);
