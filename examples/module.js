// Zeros, relative gain and step response of the quadruple tank while a valve turns.
// In a project with npm the first line is `import init, { … } from 'quadtank';`.
import init, { analyse, link, plot, published, quantities } from '../quadtank/index.js';

const field = (id) => document.getElementById(id);
const number = (value, digits = 4) => (value === null ? 'none' : value.toFixed(digits));

// Where the laboratory is, for the link.
const LABORATORY = '../';

await init();
const experiment = published('johansson-2000-minimum-phase');

function show() {
  const share = Number(field('valve').value);
  experiment.setup.valves[0] = share;
  field('share').textContent = share.toFixed(2);
  try {
    const { zeros, rga_11: relativeGain, suggestion } = analyse(experiment);
    // Where the plant is singular there is an error in the place of the answer.
    field('zeros').textContent = Array.isArray(zeros) ? zeros.map(({ value }) => number(value.re)).join(' and ') : 'not defined';
    field('relative-gain').textContent = typeof relativeGain === 'number' ? number(relativeGain, 3) : 'not defined';
    field('pairing').textContent = suggestion.pairing;
    const { 'level1.overshoot': overshoot } = quantities(experiment, ['level1.overshoot']);
    field('overshoot').textContent = overshoot === null ? 'none' : `${number(100 * overshoot, 1)} %`;
    showResponse(plot(experiment, { chart: 'responses' }));
    field('link').href = `${LABORATORY}#lab=${link(experiment)}`;
    field('message').textContent = '';
  } catch (error) {
    field('message').textContent = error.message;
  }
}

/** Shows a picture. As an image it brings no style into the page that the policy of a host might refuse. */
function showResponse(svg) {
  const image = field('response').querySelector('img') ?? field('response').appendChild(new Image());
  URL.revokeObjectURL(image.src);
  image.alt = 'Levels of tanks 1 and 2 with their references, and the voltages of both pumps';
  image.src = URL.createObjectURL(new Blob([svg], { type: 'image/svg+xml' }));
}

field('valve').addEventListener('input', show);
show();
