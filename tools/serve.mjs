// A static server for the site, or for another folder: `node tools/serve.mjs [FOLDER]` on 127.0.0.1, port 8080 or $PORT.
import { createReadStream, readFileSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const SITE = fileURLToPath(new URL('../dist', import.meta.url));
const HOST = '127.0.0.1';
const TYPES = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript; charset=utf-8',
  '.json': 'application/json',
  '.css': 'text/css; charset=utf-8',
  '.svg': 'image/svg+xml',
  '.wasm': 'application/wasm',
};

/** The file of a site that a path of the URL means; nothing outside the site. */
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
 * Serves a folder and resolves with the server once it listens; port 0 takes a free one. `compress` sends gzip 6, as plain static hosts
 * do; `headers` are sent with every file.
 */
export function serve(port, { site = SITE, compress = false, headers = {} } = {}) {
  // A host compresses a file once; doing it for every load would be measured as network.
  const packed = new Map();
  const pack = (file) => {
    if (!packed.has(file)) packed.set(file, gzipSync(readFileSync(file), { level: 6 }));
    return packed.get(file);
  };
  const server = createServer((request, response) => {
    const file = fileOf(site, request.url.split('?')[0]);
    const type = file && TYPES[extname(file)];
    if (!type) return response.writeHead(404).end();
    // Without caching, a reload shows the newest build.
    const all = { 'content-type': type, 'cache-control': 'no-store', ...headers };
    if (compress) return response.writeHead(200, { ...all, 'content-encoding': 'gzip' }).end(pack(file));
    response.writeHead(200, all);
    createReadStream(file).on('error', () => response.destroy()).pipe(response);
  });
  return new Promise((resolve, reject) => server.once('error', reject).listen(port, HOST, () => resolve(server)));
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const port = Number(process.env.PORT ?? 8080);
  const folder = process.argv[2];
  try {
    await serve(port, { site: folder ? resolve(folder) : SITE });
    console.log(`serve: ${folder ?? 'the laboratory'} is at http://${HOST}:${port}/ (Ctrl+C ends)`);
  } catch (error) {
    console.error(`serve: port ${port} cannot be used (${error.code}); choose another: make serve PORT=8081`);
    process.exitCode = 1;
  }
}
