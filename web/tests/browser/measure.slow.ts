// How fast the page is in this machine's Chromium:  npm run measure
import { readdir, readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { it } from 'vitest';
import { folder, openTab, useBrowser } from './browser';

const used = useBrowser();

const median = (numbers: number[]): number => numbers.sort((a, b) => a - b)[Math.floor(numbers.length / 2)] ?? NaN;

it('says how large it is', async () => {
  const entries = await readdir(folder, { recursive: true, withFileTypes: true });
  let sum = 0;
  for (const each of entries.filter((entry) => entry.isFile())) {
    const path = join(each.parentPath, each.name);
    const size = gzipSync(await readFile(path), { level: 9 }).length;
    sum += size;
    if (size > 10_000) console.log(`${path.slice(folder.length + 1)}: ${size} bytes gzipped`);
  }
  console.log(`in all: ${sum} bytes gzipped`);
});

it('says when the first picture is there', async () => {
  const marks = ['first picture', 'simulation'];
  const times: number[][] = marks.map(() => []);
  for (let i = 0; i < 5; ++i) {
    const tab = await openTab(used.browser, used.address);
    const found = await tab.page.evaluate((names) => names.map((name) => performance.getEntriesByName(name)[0]?.startTime ?? NaN), marks);
    found.forEach((time, k) => times[k]?.push(time));
    await tab.close();
  }
  marks.forEach((mark, k) => {
    const all = times[k] ?? [];
    console.log(`${mark}: ${all.map((time) => time.toFixed(0)).join(', ')} ms, median ${median(all).toFixed(0)}`);
  });
});

/** A cloth that hangs by two corners, and is as fine as that. */
const cloth = (count: number): string => JSON.stringify({
  pliant: 1,
  bodies: [{ name: 'cloth', mesh: { shape: 'grid', columns: count, rows: count, size: [1, 1] }, material: 'cotton',
             constraints: [{ type: 'position', on: { nearest: [[0, 0, 0], [1, 0, 0]] } }] }],
});

it('says how many pictures a second it draws', { timeout: 120_000 }, async () => {
  for (const count of [32, 100]) {
    const tab = await openTab(used.browser, used.address);
    await tab.page.locator('#files').setInputFiles({ name: `cloth${count}.json`, mimeType: 'application/json',
                                                     buffer: Buffer.from(cloth(count)) });
    await tab.page.waitForFunction((name) => globalThis.pliantPage.state.name === name, `cloth${count}`);
    await tab.page.waitForTimeout(4000);
    const begin = await tab.page.evaluate(() => ({ ...globalThis.pliantPage.state, at: performance.now() }));
    await tab.page.waitForTimeout(8000);
    const end = await tab.page.evaluate(() => ({ ...globalThis.pliantPage.state, at: performance.now() }));
    const seconds = (end.at - begin.at) / 1000;
    const title = await tab.page.locator('#rate').getAttribute('title');
    console.log(`${count} x ${count}: ${((end.pictures - begin.pictures) / seconds).toFixed(1)} pictures a second, ` +
                `${((end.time - begin.time) / seconds).toFixed(2)} x real time; ${title ?? ''}`);
    await tab.close();
  }
});
