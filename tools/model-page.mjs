// docs/model.md as a page of the site. It knows the few marks that the document uses and refuses others, so that none is shown raw.
import { SITE_POLICY, fail, inlineParts, withPolicy } from './html.mjs';

const escaped = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('"', '&quot;');

/** The name of a heading in an address, as on GitHub: `6. Zeros and directions` is `6-zeros-and-directions`. */
export const anchorOf = (heading) =>
  heading
    .toLowerCase()
    .replace(/[^\p{L}\p{N} -]/gu, '')
    .replaceAll(' ', '-');

/** Code, bold and italics within a line. */
function inline(text) {
  const codes = [];
  // A private character keeps the place of code, in which no other mark means anything.
  const marked = escaped(text.replace(/`([^`]+)`/g, (_, code) => `\uE000${codes.push(code) - 1}\uE001`))
    .replace(/\*\*([^*]+)\*\*/g, '<b>$1</b>')
    .replace(/(?<![\w*])\*([^*\s][^*]*)\*(?!\w)/g, '<i>$1</i>');
  if (/\]\(|!\[/.test(marked)) fail(`docs/model.md has a link, which its page does not know: ${text}`);
  return marked.replace(/\uE000(\d+)\uE001/g, (_, index) => `<code>${escaped(codes[index])}</code>`);
}

/** The cells of a row; `\|` is a bar within one. */
const cells = (line) =>
  line
    .trim()
    .slice(1, -1)
    .split(/(?<!\\)\|/)
    .map((cell) => inline(cell.trim().replaceAll('\\|', '|')));

const KINDS = [
  ['code', /^```/],
  ['heading', /^#{1,3} /],
  ['table', /^\|/],
  ['list', /^- /],
  ['text', /^\S/],
];

/** What a line begins; nothing for an empty one. */
const kindOf = (line) => KINDS.find(([, pattern]) => pattern.test(line))?.[0];

/** The blocks of a document: each a kind and its lines. */
function blocks(markdown) {
  const found = [];
  let open = null;
  for (const line of markdown.split('\n')) {
    const kind = kindOf(line);
    if (open?.kind === 'code') {
      if (kind === 'code') open = null;
      else open.lines.push(line);
    } else if (line.trim() === '') {
      open = null;
    } else if (kind === undefined || (kind === 'text' && ['text', 'list'].includes(open?.kind))) {
      if (open?.kind !== 'text' && open?.kind !== 'list') fail(`docs/model.md has a line that its page does not know: ${line}`);
      open.lines[open.lines.length - 1] += ` ${line.trim()}`;
    } else if (kind === 'table' || kind === 'list') {
      if (open?.kind !== kind) found.push((open = { kind, lines: [] }));
      open.lines.push(line);
    } else {
      open = { kind, lines: kind === 'code' ? [] : [line] };
      found.push(open);
      if (kind === 'heading') open = null;
    }
  }
  return found;
}

function tableOf(lines, section) {
  const [head, rule, ...rows] = lines;
  if (!/^\|[\s:|-]+\|$/.test(rule ?? '')) fail(`docs/model.md has a table without a rule: ${head}`);
  const row = (line, cell) => `<tr>${cells(line).map(cell).join('')}</tr>`;
  const heading = row(head, (cell) => (cell ? `<th scope="col">${cell}</th>` : '<td></td>'));
  const body = rows.map((line) => row(line, (cell, index) => (index === 0 && cell ? `<th scope="row">${cell}</th>` : `<td>${cell}</td>`)));
  return `<div class="wide" role="region" tabindex="0" aria-label="${escaped(section)}"><table><thead>${heading}</thead><tbody>${body.join('')}</tbody></table></div>`;
}

/** The document as HTML, with its sections. */
export function contentOf(markdown) {
  const sections = [];
  let section = '';
  const count = { table: 0, code: 0 };
  const html = blocks(markdown).map(({ kind, lines }) => {
    switch (kind) {
      case 'heading': {
        const [, marks, text] = lines[0].match(/^(#+) (.*)$/);
        const [level, anchor] = [marks.length, anchorOf(text)];
        section = text;
        [count.table, count.code] = [0, 0];
        if (level === 1) return `<h1>${inline(text)}</h1>`;
        if (level === 2) sections.push({ text, anchor });
        return `<h${level} id="${anchor}"><a href="#${anchor}">${inline(text)}</a></h${level}>`;
      }
      case 'code':
        count.code += 1;
        return `<pre role="region" tabindex="0" aria-label="${escaped(`${section}: equations ${count.code}`)}"><code>${escaped(lines.join('\n'))}</code></pre>`;
      case 'table':
        count.table += 1;
        return tableOf(lines, `${section}: table ${count.table}`);
      case 'list':
        return `<ul>${lines.map((line) => `<li>${inline(line.slice(2))}</li>`).join('')}</ul>`;
      default:
        return `<p>${inline(lines[0])}</p>`;
    }
  });
  return { html: html.join('\n'), sections };
}

/** The page, in the look of the laboratory; `sheets` are the addresses of its styles. */
export function modelPage(markdown, sheets) {
  const { html, sections } = contentOf(markdown);
  const styles = sheets.map((sheet) => `<link rel="stylesheet" href="${sheet}" />`).join('');
  const contents = sections.map(({ text, anchor }) => `<li><a href="#${anchor}">${inline(text)}</a></li>`).join('');
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
