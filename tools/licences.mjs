// Every crate of the lock file has to be under a licence that allows what this project does with it.
import { execFileSync } from 'node:child_process';

const ALLOWED = new Set([
  '0BSD',
  'Apache-2.0',
  'Apache-2.0 WITH LLVM-exception',
  'BSD-2-Clause',
  'BSD-3-Clause',
  'BSL-1.0',
  'CC0-1.0',
  'ISC',
  'MIT',
  'MPL-2.0',
  'Unicode-3.0',
  'Unlicense',
  'Zlib',
]);

/** Whether an SPDX expression can be met with the allowed licences; `/` is the old way to write OR. */
export function isAllowed(expression) {
  const tokens = expression.replaceAll('/', ' OR ').match(/\(|\)|[^\s()]+(?: WITH [^\s()]+)?/g) ?? [];
  const anyOf = () => {
    let holds = allOf();
    while (tokens[0] === 'OR') {
      tokens.shift();
      holds = allOf() || holds;
    }
    return holds;
  };
  const allOf = () => {
    let holds = one();
    while (tokens[0] === 'AND') {
      tokens.shift();
      holds = one() && holds;
    }
    return holds;
  };
  const one = () => {
    const token = tokens.shift();
    if (token !== '(') return ALLOWED.has(token);
    const holds = anyOf();
    tokens.shift();
    return holds;
  };
  return anyOf() && tokens.length === 0;
}

const metadata = execFileSync('cargo', ['metadata', '--locked', '--offline', '--format-version', '1'], {
  encoding: 'utf8',
  maxBuffer: 1 << 28,
});
const { packages } = JSON.parse(metadata);
const refused = packages.filter(({ license }) => !isAllowed(license ?? ''));
for (const { name, version, license } of refused) console.error(`licences: ${name} ${version} is under ${license ?? 'none'}`);
console.log(`licences: ${packages.length - refused.length} of ${packages.length} packages are allowed`);
process.exitCode = refused.length === 0 ? 0 : 1;
