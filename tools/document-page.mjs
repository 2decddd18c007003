// docs/model.md as a page of the site.
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

/** The document as HTML, with its sections. What is wide scrolls by itself, and has a name for who reads by ear. */
export function contentOf(markdown) {
  const sections = [];
  let section = '';
  let count = { table: 0, equations: 0 };
  const region = (kind) => `role="region" tabindex="0" aria-label="${escaped(`${section}: ${kind} ${(count[kind] += 1)}`)}"`;
  const renderer = {
    heading({ tokens, depth, text }) {
      const [html, anchor] = [this.parser.parseInline(tokens), anchorOf(text)];
      section = text;
      count = { table: 0, equations: 0 };
      if (depth === 1) return `<h1>${html}</h1>\n`;
      if (depth === 2) sections.push({ html, anchor });
      return `<h${depth} id="${anchor}"><a href="#${anchor}">${html}</a></h${depth}>\n`;
    },
    code({ text }) {
      return `<pre ${region('equations')}><code>${escaped(text)}</code></pre>\n`;
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
    // What looks like a mark of HTML is an inequality.
    html: ({ text }) => escaped(text),
  };
  return { html: new Marked({ renderer }).parse(markdown), sections };
}

/** The page, in the look of the laboratory; `sheets` are the addresses of its styles. */
export function modelPage(markdown, sheets) {
  const { html, sections } = contentOf(markdown);
  const styles = sheets.map((sheet) => `<link rel="stylesheet" href="${sheet}" />`).join('');
  const contents = sections.map(({ html: name, anchor }) => `<li><a href="#${anchor}">${name}</a></li>`).join('');
  const page = `<!doctype html>
<html lang="en" data-theme="light">
<head><meta charset="utf-8" />
<meta name="viewport" content="width=device-width, initial-scale=1" />
<title>The model · Quadtank</title>
<meta name="description" content="What the laboratory computes, in which units, from which source, what is exact and what is not." />
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
  if (refused.length > 0) fail(`the page of the model has inline parts that its policy refuses: ${refused.join(' ')}`);
  return withPolicy(page, SITE_POLICY);
}
