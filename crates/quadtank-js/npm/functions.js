// What the module answers: objects in, objects out.
import { begun } from './begin.js';

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
