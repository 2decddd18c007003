// From the click on a link to a laboratory that answers, over a network of given speed.
import { MEASURES, inBrowser } from './browser.mjs';
import { atMost, kb, progress, quantile, table } from './report.mjs';
import { serve } from '../serve.mjs';

const LOADS = 7;
const MBIT_PER_S = 10;
const ROUND_TRIP_MS = 40;
const OUTLINE_BAR_S = 0.5;
const USABLE_BAR_S = 1.5;

/** Moves a slider as soon as it is there. The page is usable when the charts of that move are painted. */
const moveAtOnce = () => {
  const watch = new MutationObserver(() => {
    const slider = document.querySelector('#bench:not(.outline) [data-testid=gamma1]');
    if (!slider) return;
    watch.disconnect();
    // Nobody moves a slider before the first frame that shows it.
    requestAnimationFrame(() =>
      setTimeout(() => {
        slider.value = '0.65';
        slider.dispatchEvent(new Event('input', { bubbles: true }));
      }),
    );
  });
  watch.observe(document, { childList: true, subtree: true });
};

/** One load in a new browser, which has nothing in its cache: times (ms) and bytes that were received. */
const loadOnce = (url) =>
  inBrowser([], async (page, session) => {
    await page.addInitScript(moveAtOnce);
    await session.send('Network.enable');
    const throughput = (MBIT_PER_S * 1e6) / 8;
    const network = { offline: false, latency: ROUND_TRIP_MS, downloadThroughput: throughput, uploadThroughput: throughput };
    await session.send('Network.emulateNetworkConditions', network);
    let bytes = 0;
    session.on('Network.loadingFinished', ({ encodedDataLength }) => (bytes += encodedDataLength));
    await page.goto(url);
    await page.waitForFunction((name) => performance.getEntriesByName(name).length > 0, MEASURES.paint);
    const times = await page.evaluate((name) => {
      const end = ({ startTime, duration }) => startTime + duration;
      return {
        outline: performance.getEntriesByName('first-contentful-paint')[0].startTime,
        usable: end(performance.getEntriesByName(name)[0]),
      };
    }, MEASURES.paint);
    return { ...times, bytes };
  });

/** Outline and usable bench over the network of the bars, files as plain static hosts send them. */
export async function load({ site }) {
  progress(`${LOADS} loads at ${MBIT_PER_S} Mbit/s`);
  const server = await serve(0, { site, compress: true, headers: { 'cache-control': 'max-age=600' } });
  const url = `http://127.0.0.1:${server.address().port}/?view=full`;
  const found = [];
  try {
    // The first one brings Chromium into the memory of the machine.
    await loadOnce(url);
    for (let k = 0; k < LOADS; k += 1) found.push(await loadOnce(url));
  } finally {
    server.close();
  }
  const row = (name, key, bar) => {
    const seconds = found.map((one) => one[key] / 1000);
    const [median, slowest] = [quantile(seconds, 0.5), Math.max(...seconds)];
    return [name, `${median.toFixed(2)} s`, `${slowest.toFixed(2)} s`, atMost(median, bar, 's')];
  };
  const bytes = found.map((one) => one.bytes);
  return table(
    [`a load at ${MBIT_PER_S} Mbit/s and ${ROUND_TRIP_MS} ms round trip, nothing cached, gzip 6`, `median of ${LOADS}`, 'slowest', 'bar'],
    [
      row('outline shown (first contentful paint)', 'outline', OUTLINE_BAR_S),
      row('home bench usable (charts painted after a move as soon as there is a slider)', 'usable', USABLE_BAR_S),
      ['received until then', kb(quantile(bytes, 0.5)), kb(Math.max(...bytes)), '–'],
    ],
  );
}
