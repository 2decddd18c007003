// Scenes of a lecture: collected from the benches, shown in order, taken elsewhere as link and file.
import { expect, test } from './lab.mjs';

async function fileMenu(lab, name) {
  await lab.page.locator('[data-testid=file-menu] > summary').click();
  await lab.id(name).click();
}

const place = (lab) => lab.text('scene-place');

/** Two scenes: Johansson's easy rig with a name, and the relay bench as it begins. */
async function collectTwo(lab) {
  await lab.open('lang=en&preset=johansson-2000-minimum-phase');
  await lab.type('gamma1-number', '0.61');
  await lab.page.locator('[data-testid=file-menu] > summary').click();
  await lab.id('experiment-name').fill('The easy side');
  await lab.id('experiment-name').press('Tab');
  await lab.id('add-scene').click();
  await expect(lab.id('notice')).toContainText('scene 1');
  await lab.page.keyboard.press('Escape');
  await lab.bench('relay-tuning');
  await fileMenu(lab, 'add-scene');
  await expect(lab.id('notice')).toContainText('scene 2');
}

test('a lecture of two scenes is collected, put in order, shown by keys, and comes back as it was', async ({ lab, page }) => {
  await collectTwo(lab);
  await lab.id('see-scenes').click();
  await expect(lab.id('scene-title-1')).toHaveValue('The easy side');
  await expect(lab.id('scene-title-2')).toHaveAttribute('placeholder', 'Relay tuning');
  await lab.id('scene-title-2').fill('Relays find the limit');
  await lab.id('scene-title-2').press('Tab');
  await lab.axe();

  await lab.id('scenes-begin').click();
  await lab.settle();
  expect(await place(lab)).toBe('1 of 2 · The easy side');
  await expect(page.locator(':root')).toHaveAttribute('data-present', 'yes');
  await lab.axe();
  await page.keyboard.press('PageDown');
  expect(await place(lab)).toBe('2 of 2 · Relays find the limit');
  await expect(lab.id('scene-next')).toBeDisabled();
  await page.keyboard.press('PageUp');
  expect(await place(lab)).toBe('1 of 2 · The easy side');
  await page.keyboard.press('Escape');
  // What was tried in a scene does not stay in it.
  await lab.type('gamma1-number', '0.3');
  await page.locator('.top h1').click();
  await page.keyboard.press('PageDown');
  await page.keyboard.press('PageUp');
  await expect.poll(() => lab.value('gamma1-number')).toBeCloseTo(0.61, 12);

  // The browser remembers them; one that is removed can be brought back.
  await page.goto(`${new URL(page.url()).origin}/?lang=en&page=scenes`);
  await lab.id('scene-down-1').click();
  await expect(lab.id('scene-title-1')).toHaveValue('Relays find the limit');
  await lab.id('scene-remove-1').click();
  await expect(lab.id('scene-2')).toHaveCount(0);
  await lab.id('bring-back').click();
  await expect(lab.id('scene-title-2')).toHaveValue('The easy side');
  // The field of a scene that goes is left once more, with what was typed into it.
  await lab.id('scene-title-1').fill('Gone');
  await lab.id('scene-remove-1').dispatchEvent('click');
  await expect(lab.id('scene-2')).toHaveCount(0);
  await expect(lab.id('scene-title-1')).toHaveValue('The easy side');
});

test('scenes leave as a file and as a link, and those that were there are not lost', async ({ lab, page, context }) => {
  await collectTwo(lab);
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await lab.id('see-scenes').click();
  const [download] = await Promise.all([page.waitForEvent('download'), lab.id('scenes-save').click()]);
  const chunks = [];
  for await (const chunk of await download.createReadStream()) chunks.push(chunk);
  const file = JSON.parse(Buffer.concat(chunks).toString());
  expect(file.scenes.map((scene) => scene.version)).toEqual([1, 2]);
  await lab.id('scenes-copy').click();
  await expect(lab.id('notice')).toBeVisible();
  const link = await page.evaluate(() => navigator.clipboard.readText());
  expect(link).toMatch(/#scenes=q1\.[\w-]+,q2\.[\w-]+$/);

  // One scene less here, and then the link again.
  await lab.id('scene-remove-2').click();
  await page.goto('about:blank');
  await page.goto(link);
  await page.locator('#bench:not(.outline)').waitFor();
  expect(await place(lab)).toBe('1 of 2 · The easy side');
  expect(await lab.value('gamma1-number')).toBeCloseTo(0.61, 12);
  await lab.id('bring-back').click();
  await expect(lab.id('scene-bar')).toBeHidden();

  const wrong = { scenes: [file.scenes[0], { ...file.scenes[1], version: 9 }] };
  await lab.id('open-input').setInputFiles({ name: 'scenes.json', mimeType: 'application/json', buffer: Buffer.from(JSON.stringify(wrong)) });
  await expect(lab.id('notice')).toContainText('Scene 2: It is a document of version 9');
  await lab.id('open-input').setInputFiles({ name: 'scenes.json', mimeType: 'application/json', buffer: Buffer.from(JSON.stringify(file)) });
  await expect.poll(() => place(lab)).toBe('1 of 2 · The easy side');
});
