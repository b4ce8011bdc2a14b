// Lets every scene of up to 3,000 vertices run for ten seconds:  npm run test:scenes
import { expect, it } from 'vitest';
import { openTab, useBrowser } from './browser';

const most = 3000;  // vertices
const time = 10_000;  // [ms]

const used = useBrowser();

it('runs every scene without an error', { timeout: 20 * 60_000 }, async () => {
  const first = await openTab(used.browser, used.address);
  await first.page.waitForFunction(() => globalThis.pliantPage.sceneNames().length > 0);  // the module is there
  const names = await first.page.evaluate(() => globalThis.pliantPage.sceneNames());
  await first.close();
  expect(names.length).toBeGreaterThan(35);
  const failed: string[] = [];
  for (const name of names) {
    const tab = await openTab(used.browser, `${used.address}#scene=${name}`);
    await tab.page.waitForFunction(() => globalThis.pliantPage.state.vertexCount > 0);
    const vertices = await tab.page.evaluate(() => globalThis.pliantPage.state.vertexCount);
    if (vertices <= most) {
      await tab.page.waitForTimeout(time);
      const state = await tab.page.evaluate(() => globalThis.pliantPage.state);
      const messages = await tab.page.locator('#messages .error').allInnerTexts();
      console.log(`${name}: ${vertices} vertices, ${state.time.toFixed(2)} s simulated, ${state.pictures} pictures`);
      if (tab.errors.length + messages.length > 0) failed.push(`${name}: ${[...tab.errors, ...messages].join('; ')}`);
      if (!(state.isPlaying && state.time > 0.3)) failed.push(`${name}: stands at ${state.time} s`);
    }
    await tab.close();
  }
  expect(failed).toEqual([]);
});
