// What the module answers: objects in, objects out. The entry points for browsers and for Node.js begin it each in its own way.
import * as laboratory from './quadtank.js';

let isReady = false;

/** Begins the module with the bytes, the response or the address of its WebAssembly; a second time nothing happens. */
export async function begin(source) {
  if (isReady) return;
  await laboratory.default({ module_or_path: await source });
  isReady = true;
}

/** The functions of the laboratory, once it has begun. */
function begun() {
  if (!isReady) throw new Error('the laboratory is not there yet: call `await init()` first');
  return laboratory;
}

/** The text of a document, which may be an object. */
function text(document) {
  const json = typeof document === 'string' ? document : JSON.stringify(document);
  if (typeof json !== 'string') throw new TypeError('a document is an object or JSON text');
  return json;
}

export const analyse = (document) => JSON.parse(begun().analyse(text(document)));
export const simulate = (document) => JSON.parse(begun().simulate(text(document)));
export const simulateCsv = (document, options = {}) => begun().simulateCsv(text(document), text(options));
export const tune = (document, options = {}) => JSON.parse(begun().tune(text(document), text(options)));
export const quantities = (document, names) => JSON.parse(begun().quantities(text(document), text(names)));
export const plot = (document, options = {}) => begun().plot(text(document), text(options));
export const warnings = (document) => JSON.parse(begun().warnings(text(document)));
export const published = (name) => JSON.parse(begun().published(String(name)));
export const publishedNames = () => JSON.parse(begun().publishedNames());
export const link = (document) => begun().link(text(document));
export const fromLink = (link) => JSON.parse(begun().fromLink(String(link)));
