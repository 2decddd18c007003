// What the browser alone needs: a page with one slider and two canvases as large as those of the home bench, four curves on each.

/** Turns a page that was at the site into the empty page, which follows its slider as the laboratory does and measures the same. */
export async function openEmptyPage(page) {
  await page.setContent(`<!doctype html><body>
    <canvas width="240" height="240"></canvas><canvas width="840" height="260"></canvas><br>
    <input type="range" min="0" max="1" step="0.001" data-testid="gamma1">`);
  await page.evaluate(followSlider);
}

const followSlider = () => {
  const slider = document.querySelector('input');
  const contexts = [...document.querySelectorAll('canvas')].map((canvas) => canvas.getContext('2d'));
  const [POINTS, CURVES] = [200, 4];
  const paint = (context) => {
    const { width, height } = context.canvas;
    context.clearRect(0, 0, width, height);
    context.lineWidth = 2;
    for (let curve = 0; curve < CURVES; curve += 1) {
      context.beginPath();
      for (let k = 0; k <= POINTS; k += 1) {
        const wave = Math.sin(k / 20 + curve + 5 * slider.valueAsNumber);
        context.lineTo((k / POINTS) * width, height * (0.5 + 0.4 * wave));
      }
      context.stroke();
    }
  };
  let since;
  slider.addEventListener('input', () => {
    if (since !== undefined) return;
    since = performance.now();
    requestAnimationFrame(() => {
      contexts.forEach(paint);
      const start = since;
      since = undefined;
      setTimeout(() => performance.measure('quadtank:paint', { start }));
    });
  });
};
