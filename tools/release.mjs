// The step between Trunk and a static host: the page gets its content security policy and must not break it, and documents get pages of their own.
import { createHash } from 'node:crypto';
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { SITE_POLICY, fail, inlineParts, withPolicy } from './html.mjs';
import { documentPage } from './document-page.mjs';

const PAGE = 'dist/index.html';

const html = readFileSync(PAGE, 'utf8');
const inline = inlineParts(html);
if (inline.length > 0) fail(`${PAGE} has inline parts that its policy refuses: ${inline.join(' ')}`);
writeFileSync(PAGE, withPolicy(html, SITE_POLICY));

// Of the styles of the laboratory the first has its colours and parts; what is for documents alone stands beside it.
const sheet = html.match(/<link\b[^>]*\brel="stylesheet"[^>]*\bhref="(?:\.\/)?(main[^"]*)"/)?.[1] ?? fail(`${PAGE} has no style sheet`);
const sheets = [sheet, 'paper.css'];
const DOCUMENTS = {
  model: { title: 'The model', description: 'What the laboratory computes, in which units, from which source, what is exact and what is not.' },
  lessons: { title: 'Lessons', description: 'How a lesson of the laboratory is written: its file, its tasks, its markup, and how it is checked.' },
  embedding: { title: 'Embedding', description: 'A bench or a lesson in a course page: frames, the element, messages, learning management systems.' },
};
for (const [name, about] of Object.entries(DOCUMENTS)) {
  writeFileSync(`dist/${name}.html`, documentPage(readFileSync(`docs/${name}.md`, 'utf8'), about, sheets));
}

// The service worker learns what the site has; the edition is named after all of it.
const OFFLINE = 'dist/offline.js';
const files = readdirSync('dist', { recursive: true, withFileTypes: true })
  .filter((entry) => entry.isFile() && !['offline.js', 'quadtank.html', 'embed.js'].includes(entry.name))
  .map((entry) => `${entry.parentPath.slice('dist'.length + 1)}/${entry.name}`.replace(/^\//, ''))
  .sort();
const edition = createHash('sha256');
for (const file of files) edition.update(readFileSync(`dist/${file}`));
const worker = readFileSync(OFFLINE, 'utf8')
  .replace('@EDITION@', edition.digest('hex').slice(0, 12))
  .replace("['@FILES@']", JSON.stringify(['./', ...files.filter((file) => file !== 'index.html')]));
writeFileSync(OFFLINE, worker);
console.log('build: the site is in dist/');
