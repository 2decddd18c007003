// Python with python-control and SciPy, in a virtual environment in target/: for comparisons with what others compute.
import { execFileSync } from 'node:child_process';
import { copyFileSync, existsSync, readFileSync, rmSync } from 'node:fs';

const REQUIREMENTS = 'benches/peer-requirements.txt';
const FOLDER = 'target/peer';

/** The interpreter of an environment with the pinned versions; made anew when these change, of which `tell` is told. */
export function python(tell) {
  const installed = `${FOLDER}/requirements.txt`;
  if (!existsSync(installed) || readFileSync(installed, 'utf8') !== readFileSync(REQUIREMENTS, 'utf8')) {
    tell(`python-control and SciPy into ${FOLDER}`);
    rmSync(FOLDER, { recursive: true, force: true });
    const stdio = ['ignore', 'ignore', 'inherit'];
    execFileSync('python3', ['-m', 'venv', FOLDER], { stdio });
    execFileSync(`${FOLDER}/bin/pip`, ['install', '--quiet', '--only-binary', ':all:', '--requirement', REQUIREMENTS], { stdio });
    copyFileSync(REQUIREMENTS, installed);
  }
  return `${FOLDER}/bin/python`;
}
