// Functions of the wasm that are alike stand side by side afterwards. A compressor finds in the near what it knows already:
// with the thousands of near copies that generic Rust compiles to, this is 3 % of the transfer. Nothing else changes.
//
// wasm-opt can sort functions by their names, so this gives every function the name of its place.
import { execFileSync } from 'node:child_process';
import { readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';

const SITE = 'dist';
/** Bytes of the pieces that functions are compared by. */
const PIECE = 4;
/** Pieces that more functions than this have tell nothing. */
const COMMON = 1500;
/** Least share of common pieces for a neighbour; below it the order of the compiler is as good. */
const ALIKE = 0.02;

const [NAME_SECTION, IMPORTS, CODE] = [0, 2, 10];
const FUNCTION_NAMES = 1;

/** Reads the numbers of a wasm file. */
class Reader {
  constructor(bytes, at) {
    this.bytes = bytes;
    this.at = at;
  }
  byte() {
    return this.bytes[this.at++];
  }
  number() {
    let value = 0;
    for (let scale = 1; ; scale *= 128) {
      const byte = this.byte();
      value += (byte & 127) * scale;
      if (byte < 128) return value;
    }
  }
  skip(count) {
    this.at += count;
  }
  limits() {
    const flags = this.byte();
    this.number();
    if (flags & 1) this.number();
  }
}

function encoded(number) {
  const bytes = [];
  do {
    bytes.push((number % 128) | (number > 127 ? 128 : 0));
    number = Math.floor(number / 128);
  } while (number > 0);
  return Buffer.from(bytes);
}

const sized = (bytes) => Buffer.concat([encoded(bytes.length), bytes]);

/** How many functions come from outside: they have the first numbers. */
function importedFunctions(reader) {
  let functions = 0;
  for (let left = reader.number(); left > 0; left--) {
    for (const _ of ['module', 'name']) reader.skip(reader.number());
    const kind = reader.byte();
    if (kind === 0) {
      functions += 1;
      reader.number();
    } else if (kind === 1) {
      reader.skip(1);
      reader.limits();
    } else if (kind === 2) {
      reader.limits();
    } else if (kind === 3) {
      reader.skip(2);
    } else {
      throw new Error(`an import of kind ${kind} is not known here`);
    }
  }
  return functions;
}

function partsOf(wasm) {
  const parts = { imported: 0, bodies: [] };
  const reader = new Reader(wasm, 8);
  while (reader.at < wasm.length) {
    const kind = reader.byte();
    const length = reader.number();
    const end = reader.at + length;
    if (kind === IMPORTS) parts.imported = importedFunctions(reader);
    if (kind === CODE) {
      for (let left = reader.number(); left > 0; left--) {
        const size = reader.number();
        parts.bodies.push(wasm.subarray(reader.at, reader.at + size));
        reader.skip(size);
      }
    }
    reader.at = end;
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
