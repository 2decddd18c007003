// The laboratory in Node.js, which does not fetch files.
import { readFile } from 'node:fs/promises';
import { begin } from './begin.js';

export * from './functions.js';

/** Loads the laboratory, from beside this file if nothing else is said. */
export default function init(source = readFile(new URL('./quadtank_bg.wasm', import.meta.url))) {
  return begin(source);
}
