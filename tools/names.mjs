// What the wasm imports from its script gets short names, in both files: wasm-bindgen ends each name with sixteen digits of a
// hash that no compressor can shorten. That is 4.5 KB of transfer. The hashes keep different versions of wasm-bindgen apart
// within one module; when the module is linked, they have done their work.
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { IMPORTS, encoded, imports, sections, sized } from './wasm.mjs';
import { fail } from './html.mjs';

const SITE = 'dist';
const HASHED = /\b__wb(?:g|indgen)_\w+\b/g;

const [wasmFile, scriptFile] = ['_bg.wasm', '.js'].map((end) => {
  const name = readdirSync(SITE).find((name) => name.startsWith('quadtank-lab') && name.endsWith(end));
  return `${SITE}/${name ?? fail(`${SITE} has no file quadtank-lab…${end}`)}`;
});
const wasm = readFileSync(wasmFile);
const section = [...sections(wasm)].find(({ kind }) => kind === IMPORTS);
const all = [...imports(wasm, section.content)];
const shortOf = new Map(all.map(({ field }, index) => [field.toString(), index.toString(36)]));

const entries = all.map(({ module, field, what }) =>
  Buffer.concat([sized(module), sized(Buffer.from(shortOf.get(field.toString()))), what]),
);
const content = sized(Buffer.concat([encoded(all.length), ...entries]));
writeFileSync(wasmFile, Buffer.concat([wasm.subarray(0, section.begin), encoded(IMPORTS), content, wasm.subarray(section.end)]));

// In the script each name is the key of its function, quoted because a short one may begin with a digit.
const script = readFileSync(scriptFile, 'utf8').replace(HASHED, (name) => (shortOf.has(name) ? `'${shortOf.get(name)}'` : name));
const kept = [...shortOf.keys()].filter((name) => script.includes(name));
if (kept.length > 0) fail(`${scriptFile} still has the names ${kept.join(' ')}`);
writeFileSync(scriptFile, script);
