// The site as a careful host would serve it: strict content security policy, right types, under any path. Each call of
// `serve` takes a free port, so a second call is another origin.
import { createReadStream, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';

/** The release build that is tested; another one by the variable QUADTANK_DIST. */
export const SITE = process.env.QUADTANK_DIST ?? fileURLToPath(new URL('../../dist', import.meta.url));

export const POLICY =
  "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; " +
  "img-src 'self' data: blob:; connect-src 'self'; frame-src 'self'; worker-src 'self'; manifest-src 'self'";

const HTML = 'text/html; charset=utf-8';
const TYPES = {
  '.html': HTML,
  '.js': 'text/javascript; charset=utf-8',
  '.css': 'text/css; charset=utf-8',
  '.svg': 'image/svg+xml',
  '.wasm': 'application/wasm',
  '.json': 'application/json',
  '.webmanifest': 'application/manifest+json',
};

/** The file of a site that a path means; nothing outside the site. */
function fileOf(site, path) {
  try {
    const file = join(site, normalize(`/${decodeURIComponent(path)}`));
    const found = statSync(file);
    return found.isDirectory() ? join(file, 'index.html') : file;
  } catch {
    return null;
  }
}

/**
 * Serves `dist/`, or another `site`, under `base`, and the given extra pages (path → HTML, without a policy of their own) beside it.
 * `open` adds the header that a sandboxed frame needs.
 */
export async function serve({ site = SITE, base = '/', pages = {}, open = false } = {}) {
  const server = createServer((request, response) => {
    const path = request.url.split('?')[0];
    if (pages[path]) return response.writeHead(200, { 'content-type': HTML }).end(pages[path]);
    // Browsers ask for it on pages that name no icon; that is no failure of the page.
    if (path === '/favicon.ico') return response.writeHead(204).end();
    const file = path.startsWith(base) ? fileOf(site, path.slice(base.length)) : null;
    const type = file && TYPES[extname(file)];
    if (!type) return response.writeHead(404).end();
    const headers = { 'content-type': type };
    // The single file brings its own policy, with the hashes of what is inlined.
    if (!file.endsWith('quadtank.html')) headers['content-security-policy'] = POLICY;
    if (open) headers['access-control-allow-origin'] = '*';
    response.writeHead(200, headers);
    createReadStream(file).pipe(response);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { origin: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
}
