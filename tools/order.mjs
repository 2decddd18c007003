// Functions of the wasm that are alike stand side by side afterwards. A compressor finds in the near what it knows already:
// with the thousands of near copies that generic Rust compiles to, this is 3 % of the transfer. Nothing else changes.
//
// wasm-opt can sort functions by their names, so this gives every function the name of its place.
import { execFileSync } from 'node:child_process';
import { readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { CODE, IMPORTS, NAME_SECTION, Reader, encoded, imports, sections, sized } from './wasm.mjs';

const SITE = 'dist';
/** Bytes of the pieces that functions are compared by. */
const PIECE = 4;
/** Pieces that more functions than this have tell nothing. */
const COMMON = 1500;
/** Least share of common pieces for a neighbour; below it the order of the compiler is as good. */
const ALIKE = 0.02;

const FUNCTION_NAMES = 1;

function partsOf(wasm) {
  const parts = { imported: 0, bodies: [] };
  for (const { kind, content } of sections(wasm)) {
    if (kind === IMPORTS) parts.imported = [...imports(wasm, content)].filter(({ isFunction }) => isFunction).length;
    if (kind === CODE) {
      const reader = new Reader(wasm, content);
      for (let left = reader.number(); left > 0; left--) {
        const size = reader.number();
        parts.bodies.push(wasm.subarray(reader.at, reader.at + size));
        reader.skip(size);
      }
    }
  }
  return parts;
}

const piecesOf = (body) => new Set(Array.from({ length: Math.max(0, body.length - PIECE + 1) }, (_, k) => body.readUInt32LE(k)));

/** Each function is followed by the one that is most like it among those that are left. */
function orderOf(bodies) {
  const pieces = bodies.map(piecesOf);
  const holders = new Map();
  pieces.forEach((set, index) => {
    for (const piece of set) {
      if (!holders.has(piece)) holders.set(piece, []);
      holders.get(piece).push(index);
    }
  });
  const placed = new Set();
  const order = [];
  const place = (index) => {
    placed.add(index);
    order.push(index);
  };
  const nextTo = (index) => {
    const common = new Map();
    for (const piece of pieces[index]) {
      const others = holders.get(piece);
      if (others.length > COMMON) continue;
      for (const other of others) if (!placed.has(other)) common.set(other, (common.get(other) ?? 0) + 1);
    }
    let [best, most] = [undefined, ALIKE];
    for (const [other, count] of common) {
      const share = count / (pieces[index].size + pieces[other].size - count);
      if (share > most) [best, most] = [other, share];
    }
    return best;
  };
  for (let first = 0; first < bodies.length; first++) {
    for (let next = placed.has(first) ? undefined : first; next !== undefined; next = nextTo(next)) place(next);
  }
  return order;
}

/** The section that names functions by their places. */
function names({ imported, bodies }) {
  const nameOf = [];
  const padded = (number) => String(number).padStart(6, '0');
  for (let index = 0; index < imported; index++) nameOf[index] = `a${padded(index)}`;
  orderOf(bodies).forEach((index, position) => (nameOf[imported + index] = `b${padded(position)}`));
  const entries = nameOf.map((name, index) => Buffer.concat([encoded(index), sized(Buffer.from(name))]));
  const map = Buffer.concat([encoded(entries.length), ...entries]);
  const content = Buffer.concat([sized(Buffer.from('name')), Buffer.from([FUNCTION_NAMES]), sized(map)]);
  return Buffer.concat([Buffer.from([NAME_SECTION]), sized(content)]);
}

for (const name of readdirSync(SITE).filter((name) => name.endsWith('.wasm'))) {
  const file = `${SITE}/${name}`;
  const named = `${file}.named`;
  const wasm = readFileSync(file);
  writeFileSync(named, Buffer.concat([wasm, names(partsOf(wasm))]));
  execFileSync('wasm-opt', [named, '--reorder-functions-by-name', '--strip-debug', '-o', file], { stdio: 'inherit' });
  rmSync(named);
}
