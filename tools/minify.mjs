// The last step of the release: script and style sheets lose what only people need. Names of files stay.
import { execFileSync } from 'node:child_process';
import { readdirSync } from 'node:fs';

const SITE = 'dist';

for (const name of readdirSync(SITE).filter((name) => /\.(?:js|css)$/.test(name))) {
  const file = `${SITE}/${name}`;
  execFileSync('esbuild', [file, '--minify', '--log-level=warning', `--outfile=${file}`, '--allow-overwrite'], { stdio: 'inherit' });
}
