// A document of docs/ as a page of the site.
import { createRequire } from 'node:module';
import { SITE_POLICY, fail, inlineParts, withPolicy } from './html.mjs';

// The tools of Node.js are installed beside the end-to-end tests.
const { Marked } = createRequire(new URL('../tests/e2e/package.json', import.meta.url))('marked');

const escaped = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('"', '&quot;');

/** The name of a heading in an address, as on GitHub: `6. Zeros and directions` is `6-zeros-and-directions`. */
export const anchorOf = (heading) =>
  heading
    .toLowerCase()
    .replace(/[^\p{L}\p{N} -]/gu, '')
    .replaceAll(' ', '-');

/** The documents that are pages; a link to another file of the source leads nowhere on the site. */
const PAGES = ['model', 'lessons', 'embedding'];

/** The document as HTML, with its sections. What is wide scrolls by itself, and has a name for who reads by ear. */
export function contentOf(markdown) {
  const sections = [];
  let section = '';
  let count = {};
  const region = (kind) => `role="region" tabindex="0" aria-label="${escaped(`${section}: ${kind} ${(count[kind] = (count[kind] ?? 0) + 1)}`)}"`;
  const renderer = {
    heading({ tokens, depth, text }) {
      const [html, anchor] = [this.parser.parseInline(tokens), anchorOf(text)];
      section = text;
      count = {};
      if (depth === 1) return `<h1>${html}</h1>\n`;
      if (depth === 2) sections.push({ html, anchor });
      return `<h${depth} id="${anchor}"><a href="#${anchor}">${html}</a></h${depth}>\n`;
    },
    // What names a language is a file; the equations of the model are plain.
    code({ text, lang }) {
      return `<pre ${region(lang ? 'file' : 'equations')}><code>${escaped(text)}</code></pre>\n`;
    },
    table({ header, rows }) {
      const cell = ({ tokens }, scope) => {
        const html = this.parser.parseInline(tokens);
        return scope && html ? `<th scope="${scope}">${html}</th>` : `<td>${html}</td>`;
      };
      const head = header.map((each) => cell(each, 'col')).join('');
      const body = rows.map((row) => `<tr>${row.map((each, index) => cell(each, index === 0 && 'row')).join('')}</tr>`).join('');
      return `<div class="wide" ${region('table')}><table><thead><tr>${head}</tr></thead><tbody>${body}</tbody></table></div>\n`;
    },
    link({ href, tokens }) {
      const words = this.parser.parseInline(tokens);
      if (/^(https?:|#)/.test(href)) return `<a href="${escaped(href)}">${words}</a>`;
      const [, page, anchor = ''] = href.match(/^([a-z-]+)\.md(#[\w-]+)?$/) ?? [];
      return PAGES.includes(page) ? `<a href="${page}.html${anchor}">${words}</a>` : words;
    },
    // What looks like a mark of HTML is an inequality.
    html: ({ text }) => escaped(text),
  };
  return { html: new Marked({ renderer }).parse(markdown), sections };
}

/** The page, in the look of the laboratory; `sheets` are the addresses of its styles. */
export function documentPage(markdown, { title, description }, sheets) {
  const { html, sections } = contentOf(markdown);
  const styles = sheets.map((sheet) => `<link rel="stylesheet" href="${sheet}" />`).join('');
  const contents = sections.map(({ html: name, anchor }) => `<li><a href="#${anchor}">${name}</a></li>`).join('');
  const page = `<!doctype html>
<html lang="en" data-theme="light">
<head><meta charset="utf-8" />
<meta name="viewport" content="width=device-width, initial-scale=1" />
<title>${title} · Quadtank</title>
<meta name="description" content="${description}" />
${styles}<link rel="icon" href="icon.svg" />
<script src="theme.js"></script>
</head>
<body>
<header class="top"><a class="button" href="./">Quadtank</a><span class="remark">documentation</span></header>
<div class="paper">
<nav aria-label="Contents"><ul>${contents}</ul></nav>
<main id="bench">
${html}
</main>
</div>
</body>
</html>
`;
  const refused = inlineParts(page);
  if (refused.length > 0) fail(`the page “${title}” has inline parts that its policy refuses: ${refused.join(' ')}`);
  return withPolicy(page, SITE_POLICY);
}
