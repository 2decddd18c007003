// The laboratory in a browser.
import { begin } from './begin.js';

export * from './functions.js';

/** Loads the laboratory, from beside this file if nothing else is said. */
export default function init(source = new URL('./quadtank_bg.wasm', import.meta.url)) {
  return begin(source);
}
