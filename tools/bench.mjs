// Measures what there are bars for, and prints it as Markdown, with the machine.
//
//   --write          puts it into docs/benchmarks.md
//   --site <folder>  measures another build than dist/
//   --only <parts>   some parts alone, separated by commas; --without <parts> all but some
//
// PEER=1 and LIGHTHOUSE=1 measure these parts too; the first time they fetch what they need into target/. `make bench` builds the site
// before; `tools/run.sh node tools/bench.mjs` measures one that is there.
import { existsSync } from 'node:fs';
import { parseArgs } from 'node:util';
import { frames } from './bench/frames.mjs';
import { lighthouse } from './bench/lighthouse.mjs';
import { load } from './bench/load.mjs';
import { memory } from './bench/memory.mjs';
import { native } from './bench/native.mjs';
import { peer } from './bench/peer.mjs';
import { machine, write } from './bench/report.mjs';
import { lines, sizes } from './bench/sizes.mjs';
import { serve } from './serve.mjs';

/** Each part makes a table of its own, in this order. */
const PARTS = { frames, peer, load, lighthouse, memory, native, sizes, lines };
const OPTIONAL = { peer: 'PEER', lighthouse: 'LIGHTHOUSE' };

/** The clock of an isolated page ticks in 5 µs, that of others in 100. */
const ISOLATED = { 'cross-origin-opener-policy': 'same-origin', 'cross-origin-embedder-policy': 'require-corp' };

function options() {
  const text = { type: 'string' };
  const { values } = parseArgs({ options: { write: { type: 'boolean' }, site: text, only: text, without: text } });
  const { site = 'dist', only, without } = values;
  if (!existsSync(`${site}/index.html`)) throw new Error(`there is no site in ${site}; make build makes one in dist`);
  const named = (list) => list?.split(',') ?? [];
  const unknown = [...named(only), ...named(without)].find((part) => !(part in PARTS));
  if (unknown !== undefined) throw new Error(`there is no part ${unknown}; the parts are ${Object.keys(PARTS).join(', ')}`);
  const isWhole = only === undefined && without === undefined;
  const isWritten = values.write ?? false;
  if (isWritten && !(isWhole && site === 'dist')) throw new Error('--write is for a whole run of dist');
  const isAsked = (part) => (only ? named(only).includes(part) : !(part in OPTIONAL) || process.env[OPTIONAL[part]] === '1');
  return { site, isWhole, isWritten, parts: Object.keys(PARTS).filter((part) => isAsked(part) && !named(without).includes(part)) };
}

async function main() {
  const { site, parts, isWhole, isWritten } = options();
  const results = [await machine()];
  const server = await serve(0, { site, headers: ISOLATED });
  const context = { site, url: `http://127.0.0.1:${server.address().port}/` };
  const failed = [];
  for (const part of parts) {
    try {
      results.push(await PARTS[part](context));
    } catch (error) {
      // What the other parts took minutes for is worth printing all the same.
      failed.push(part);
      results.push(`**${part} could not be measured**: ${error.message}`);
    }
  }
  server.close();
  const left = Object.keys(OPTIONAL).filter((part) => isWhole && !parts.includes(part));
  results.push(...left.map((part) => `Not in this run: ${part} (\`${OPTIONAL[part]}=1\`).`));
  const report = results.join('\n\n');
  console.log(report);
  if (failed.length > 0) throw new Error(`could not measure ${failed.join(', ')}${isWritten ? '; nothing is written' : ''}`);
  if (isWritten) write(report);
}

try {
  await main();
} catch (error) {
  console.error(`bench: ${error.message}`);
  process.exitCode = 1;
}
