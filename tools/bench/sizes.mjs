// The size of the site, and of its source.
import { readFileSync } from 'node:fs';
import { relative } from 'node:path';
import { brotliCompressSync, constants, gzipSync } from 'node:zlib';
import { atMost, files, kb, table } from './report.mjs';

const SINGLE = 'quadtank.html';
const SITE_BAR_KB = 800;
/** Files that are smaller than this (bytes, gzip) stand in one row. */
const SMALL = 1000;

/** Size (bytes) of a file: as it is, as plain static hosts send it, and as careful ones do. */
function size(file) {
  const bytes = readFileSync(file);
  const brotli = brotliCompressSync(bytes, { params: { [constants.BROTLI_PARAM_QUALITY]: 11 } });
  return { plain: bytes.length, gzip: gzipSync(bytes, { level: 6 }).length, brotli: brotli.length };
}

const sum = (all, key) => all.reduce((total, one) => total + one[key], 0);
const total = (all) => ({ plain: sum(all, 'plain'), gzip: sum(all, 'gzip'), brotli: sum(all, 'brotli') });

/** Sizes of the whole site and of its parts; the single file is another way to have the same. */
export function sizes({ site }) {
  const all = files(site).map((file) => ({ name: relative(site, file), ...size(file) }));
  const parts = all.filter(({ name }) => name !== SINGLE).sort((one, other) => other.gzip - one.gzip);
  const [big, small] = [parts.filter(({ gzip }) => gzip >= SMALL), parts.filter(({ gzip }) => gzip < SMALL)];
  const row = (name, { plain, gzip, brotli }, bar) => [name, kb(plain), kb(gzip), kb(brotli), bar];
  const whole = total(parts);
  return table(
    ['file', 'plain', 'gzip 6', 'brotli 11', 'bar'],
    [
      ...big.map((file) => row(file.name, file, '')),
      ...(small.length > 0 ? [row(`${small.length} files below ${kb(SMALL)}`, total(small), '')] : []),
      row('**the whole site**', whole, `gzip 6 ${atMost(whole.gzip / 1000, SITE_BAR_KB, 'KB')}`),
      ...all.filter(({ name }) => name === SINGLE).map((file) => row(`${file.name} (apart)`, file, '')),
    ],
  );
}

/** Parts of the source: their folders and how their files end. Tests inside a module count with the module. */
const SOURCE = [
  ['`src`: the page', /^src\/.*\.rs$/],
  ['`crates/*/src`: what is not the page', /^crates\/[^/]+\/src\/.*\.rs$/],
  ['`crates/*/tests` and `benches`', /^crates\/[^/]+\/(tests|benches)\/.*\.rs$/],
  ['`tests`: browser and end-to-end', /^tests\/.*\.(rs|mjs)$/],
];

/** Lines of the source. */
export function lines() {
  const all = ['src', 'crates', 'tests'].flatMap(files);
  const rows = SOURCE.map(([name, pattern]) => {
    const counts = all.filter((file) => pattern.test(file)).map((file) => readFileSync(file, 'utf8').split('\n').length - 1);
    return [name, counts.length, counts.reduce((total, count) => total + count, 0), Math.max(0, ...counts)];
  });
  return table(['source', 'files', 'lines', 'longest file'], rows);
}
