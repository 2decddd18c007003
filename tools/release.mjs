// The step between Trunk and a static host: the page gets its content security policy and must not break it.
import { readFileSync, writeFileSync } from 'node:fs';
import { SITE_POLICY, fail, inlineParts, withPolicy } from './html.mjs';

const PAGE = 'dist/index.html';

const html = readFileSync(PAGE, 'utf8');
const inline = inlineParts(html);
if (inline.length > 0) fail(`${PAGE} has inline parts that its policy refuses: ${inline.join(' ')}`);
writeFileSync(PAGE, withPolicy(html, SITE_POLICY));
console.log('build: the site is in dist/');
