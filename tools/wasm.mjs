// What the steps of the release share that look into a wasm file.

/** Reads the numbers of a wasm file. */
export class Reader {
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

export function encoded(number) {
  const bytes = [];
  do {
    bytes.push((number % 128) | (number > 127 ? 128 : 0));
    number = Math.floor(number / 128);
  } while (number > 0);
  return Buffer.from(bytes);
}

export const sized = (bytes) => Buffer.concat([encoded(bytes.length), bytes]);

/** Sections of a module. */
export const [NAME_SECTION, IMPORTS, CODE] = [0, 2, 10];

/** Every section of a module: its kind, where it begins, where its content begins, and where it ends. */
export function* sections(wasm) {
  const reader = new Reader(wasm, 8);
  while (reader.at < wasm.length) {
    const begin = reader.at;
    const kind = reader.byte();
    const length = reader.number();
    const content = reader.at;
    reader.at = content + length;
    yield { kind, begin, content, end: reader.at };
  }
}

/** Every import: its two names, whether it is a function, and the bytes of what it is. */
export function* imports(wasm, content) {
  const reader = new Reader(wasm, content);
  const name = () => {
    const length = reader.number();
    reader.skip(length);
    return wasm.subarray(reader.at - length, reader.at);
  };
  for (let left = reader.number(); left > 0; left--) {
    const [module, field] = [name(), name()];
    const begin = reader.at;
    const kind = reader.byte();
    if (kind === 0) {
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
    yield { module, field, isFunction: kind === 0, what: wasm.subarray(begin, reader.at) };
  }
}
