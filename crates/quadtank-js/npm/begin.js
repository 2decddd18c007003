// The WebAssembly of the module. The entry points for browsers and for Node.js begin it each in its own way.
import * as laboratory from './quadtank.js';

let isReady = false;

/** Begins the module with the bytes, the response or the address of its WebAssembly; a second time nothing happens. */
export async function begin(source) {
  if (isReady) return;
  await laboratory.default({ module_or_path: await source });
  isReady = true;
}

/** The functions of the laboratory, once it has begun. */
export function begun() {
  if (!isReady) throw new Error('the laboratory is not there yet: call `await init()` first');
  return laboratory;
}
