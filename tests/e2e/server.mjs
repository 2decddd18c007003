// The site as a careful host would serve it: strict content security policy, right types, under a sub-path.
import { createReadStream, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';

export const SITE = fileURLToPath(new URL('../../dist', import.meta.url));

export const POLICY =
  "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; " +
  "img-src 'self' data: blob:; connect-src 'self'";

const TYPES = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript; charset=utf-8',
  '.css': 'text/css; charset=utf-8',
  '.svg': 'image/svg+xml',
  '.wasm': 'application/wasm',
};

/**
 * Serves `dist/` under `base`, and the given extra pages (path → HTML, without a policy of their own) beside it.
 * `open` adds the header that a sandboxed frame needs.
 */
export async function serve({ base = '/', pages = {}, open = false } = {}) {
  const server = createServer((request, response) => {
    const path = request.url.split('?')[0];
    if (pages[path]) return response.writeHead(200, { 'content-type': TYPES['.html'] }).end(pages[path]);
    if (!path.startsWith(base)) return response.writeHead(404).end();
    let file = join(SITE, normalize(`/${decodeURIComponent(path.slice(base.length))}`));
    try {
      if (statSync(file).isDirectory()) file = join(file, 'index.html');
    } catch {
      return response.writeHead(404).end();
    }
    const headers = { 'content-type': TYPES[extname(file)] ?? 'application/octet-stream' };
    // The single file brings its own policy, with the hashes of what is inlined.
    if (!file.endsWith('quadtank.html')) headers['content-security-policy'] = POLICY;
    if (open) headers['access-control-allow-origin'] = '*';
    response.writeHead(200, headers);
    createReadStream(file).pipe(response);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { origin: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
}
