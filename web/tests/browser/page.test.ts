import { readdir, readFile } from 'node:fs/promises';
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { afterEach, describe, expect, it } from 'vitest';
import { folder, openTab, program, type Tab, type TabOptions, until, useBrowser } from './browser';

const hasBrowser = existsSync(program);
if (!hasBrowser) console.warn(`skipped: no ${program} (apt-get install chromium)`);

let used: ReturnType<typeof useBrowser>;
const tabs: Tab[] = [];

async function open(hash = '', options: TabOptions = {}): Promise<Tab> {
  const tab = await openTab(used.browser, used.address + hash, options);
  tabs.push(tab);
  return tab;
}

/** Where vertex `v` is in the picture. */
const placeOf = (tab: Tab, v: number): Promise<{ x: number; y: number }> =>
  tab.page.evaluate((vertex) => globalThis.pliantPage.placeOf(vertex), v);

/** Stops it where it begins, so that nothing moves or lies in front of anything. */
async function stopAtStart(tab: Tab): Promise<void> {
  await tab.page.locator('#play').click();
  await until(tab, () => !globalThis.pliantPage.state.isPlaying);
  await tab.page.locator('#restart').click();
  await until(tab, () => globalThis.pliantPage.state.time === 0);
}

const pinsOf = (tab: Tab): Promise<number[]> => tab.page.evaluate(() => globalThis.pliantPage.state.pins);

/** Of two pictures, in the mean of all pixels and colors, of 255. */
async function difference(tab: Tab, a: Buffer, b: Buffer): Promise<number> {
  return tab.page.evaluate(async (pictures) => {
    const [one, other] = await Promise.all(pictures.map(async (picture) => {
      const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${picture}`)).blob());
      const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
      context?.drawImage(bitmap, 0, 0);
      return context?.getImageData(0, 0, bitmap.width, bitmap.height).data ?? new Uint8ClampedArray();
    }));
    if (one === undefined || other === undefined || one.length === 0 || one.length !== other.length) return Infinity;
    let sum = 0;
    for (let i = 0; i < one.length; ++i) sum += Math.abs((one[i] ?? 0) - (other[i] ?? 0));
    return sum / one.length;
  }, [a.toString('base64'), b.toString('base64')]);
}

/** The picture alone. */
const bare = '#bar, #panel, #time, #hint, #messages, #loading { display: none !important }';

const messagesOf = (tab: Tab): Promise<string> => tab.page.locator('#messages').innerText();

describe.runIf(hasBrowser)('the page', () => {
  used = useBrowser();
  afterEach(async () => {
    const errors = tabs.flatMap((tab) => tab.errors);
    for (const tab of tabs.splice(0)) await tab.close();
    expect(errors).toEqual([]);
  });

  it('asks for nothing from elsewhere, and moves', async () => {
    const tab = await open();
    const before = await tab.page.evaluate(() => globalThis.pliantPage.state.time);
    await tab.page.waitForTimeout(1000);
    expect(await tab.page.evaluate(() => globalThis.pliantPage.state.time)).toBeGreaterThan(before + 0.2);
    await tab.page.locator('#choose').click();
    await tab.page.waitForTimeout(300);
    expect(tab.requests.filter((each) => !each.startsWith(used.address) && !each.startsWith('blob:'))).toEqual([]);
  });

  it('shows the scene before the simulation is there, from where it stays', async () => {
    const context = await used.browser.newContext({ viewport: { width: 1280, height: 720 } });
    const page = await context.newPage();
    let release = (): void => undefined;
    const isAllowed = new Promise<void>((resolve) => (release = resolve));
    await page.route('**/*.wasm', async (route) => {
      await isAllowed;
      await route.continue();
    });
    const errors: string[] = [];
    page.on('pageerror', (error) => errors.push(String(error)));
    const tab: Tab = { page, errors, requests: [], close: () => context.close() };
    tabs.push(tab);
    await page.goto(used.address);
    await until(tab, () => globalThis.pliantPage?.state.pictures === 1);
    expect(await page.title()).toContain('turning ball');
    expect(await page.evaluate(() => globalThis.pliantPage.state.vertexCount)).toBe(0);
    const viewpoint = await page.evaluate(() => globalThis.pliantPage.viewpoint());
    const place = await placeOf(tab, 0);
    const early = await page.locator('#picture').screenshot({ style: bare });
    // Nothing can be pinned yet.
    await page.mouse.click(place.x, place.y);
    release();
    await until(tab, () => globalThis.pliantPage.state.vertexCount > 0);
    await stopAtStart(tab);
    expect(await page.evaluate(() => globalThis.pliantPage.viewpoint())).toEqual(viewpoint);
    expect(await placeOf(tab, 0)).toEqual(place);
    expect(await pinsOf(tab)).toEqual([]);
    const late = await page.locator('#picture').screenshot({ style: bare });
    expect(await difference(tab, early, late)).toBeLessThan(0.3);
  });

  it('shows values as colors, and the edges of the triangles', async () => {
    const tab = await open('#scene=flag');
    await tab.page.waitForTimeout(1200);
    await tab.page.locator('#play').click();
    await until(tab, () => !globalThis.pliantPage.state.isPlaying);
    const picture = (): Promise<Buffer> => tab.page.locator('#picture').screenshot();
    const plain = await picture();
    await tab.page.locator('#panel summary', { hasText: 'View' }).click();
    await tab.page.locator('select[aria-label=Color] option').nth(5).waitFor({ state: 'attached' });
    await tab.page.locator('select[aria-label=Color]').selectOption('stretch');
    await tab.page.locator('#legend').waitFor({ state: 'visible' });
    expect(await tab.page.locator('#legend').innerText()).toContain('stretch [%]');
    await tab.page.waitForTimeout(300);
    const colored = await picture();
    expect(await difference(tab, plain, colored)).toBeGreaterThan(1);
    await tab.page.locator('#picture').focus();
    await tab.page.keyboard.press('w');
    await tab.page.waitForTimeout(300);
    expect(await difference(tab, colored, await picture())).toBeGreaterThan(0.5);
    // On for the third time, the surface still moves.
    await tab.page.keyboard.press('w');
    await tab.page.keyboard.press('w');
    await tab.page.waitForTimeout(300);
    await tab.page.keyboard.press('w');
    await tab.page.waitForTimeout(300);
    const still = await picture();
    await tab.page.keyboard.press('Space');
    await tab.page.waitForTimeout(800);
    await tab.page.keyboard.press('Space');
    await tab.page.waitForTimeout(300);
    expect(await difference(tab, still, await picture())).toBeGreaterThan(0.5);
    for (let i = 0; i < 5; ++i) await tab.page.keyboard.press('c');
    await tab.page.locator('#legend').waitFor({ state: 'hidden' });
  });

  it('has less than 1.5 MB in all', async () => {
    const names = await readdir(folder, { recursive: true, withFileTypes: true });
    let size = 0;
    for (const each of names.filter((entry) => entry.isFile())) {
      size += gzipSync(await readFile(join(each.parentPath, each.name)), { level: 9 }).length;
    }
    expect(size).toBeLessThan(1.5e6);
  });

  it('pulls the cloth where the mouse goes, and lets it go', async () => {
    const tab = await open('#scene=curtain');
    await stopAtStart(tab);
    const middle = 840;
    const from = await placeOf(tab, middle);
    await tab.page.mouse.move(from.x, from.y);
    await tab.page.mouse.down();
    await tab.page.mouse.move(from.x - 60, from.y + 10, { steps: 4 });
    await tab.page.keyboard.press('Space');
    await tab.page.mouse.move(from.x - 120, from.y + 20, { steps: 10 });
    await tab.page.waitForTimeout(3000);  // it swings for two seconds
    const held = await placeOf(tab, middle);
    expect(Math.hypot(held.x - (from.x - 120), held.y - (from.y + 20))).toBeLessThan(60);
    await tab.page.mouse.up();
    await tab.page.waitForTimeout(4000);
    const after = await placeOf(tab, middle);
    expect(Math.hypot(after.x - held.x, after.y - held.y)).toBeGreaterThan(40);
  });

  it('pins by a click, lets go by another, and takes both back', async () => {
    const tab = await open('#scene=curtain');
    await stopAtStart(tab);
    const pins = await pinsOf(tab);
    const place = await placeOf(tab, 700);
    await tab.page.mouse.click(place.x, place.y);
    await until(tab, () => globalThis.pliantPage.state.pins.includes(700));
    await tab.page.mouse.click(place.x, place.y);
    await until(tab, () => !globalThis.pliantPage.state.pins.includes(700));
    await tab.page.keyboard.press('Control+z');
    await until(tab, () => globalThis.pliantPage.state.pins.includes(700));
    await tab.page.locator('#undo').click();
    await until(tab, () => !globalThis.pliantPage.state.pins.includes(700));
    expect(await pinsOf(tab)).toEqual(pins);
    expect(await tab.page.locator('#undo').isDisabled()).toBe(true);
  });

  it('turns the camera beside the bodies, and frames them again', async () => {
    const tab = await open('#scene=curtain');
    await stopAtStart(tab);
    const before = await placeOf(tab, 0);
    await tab.page.mouse.move(30, 400);
    await tab.page.mouse.down();
    await tab.page.mouse.move(200, 380, { steps: 5 });
    await tab.page.mouse.up();
    const turned = await placeOf(tab, 0);
    expect(Math.hypot(turned.x - before.x, turned.y - before.y)).toBeGreaterThan(20);
    await tab.page.keyboard.press('f');
    const again = await placeOf(tab, 0);
    const far = (place: { x: number; y: number }): number => Math.hypot(place.x - before.x, place.y - before.y);
    expect(far(again)).toBeLessThan(far(turned) / 3);
  });

  it('moves the camera as the scene does, until someone turns it', async () => {
    const tab = await open('#scene=flag');
    const scene = {
      pliant: 1,
      bodies: [{ name: 'cloth', mesh: { shape: 'grid', columns: 5, rows: 5 }, material: 'cotton' }],
      view: { camera: { keyframes: [{ time: 0, position: [0, -4, 1], target: [0, 0, 0] },
                                    { time: 0.5, position: [3, -4, 1], target: [3, 0, 0] }] } },
    };
    await tab.page.locator('#files').setInputFiles({ name: 'moves.json', mimeType: 'application/json', buffer: Buffer.from(JSON.stringify(scene)) });
    await until(tab, () => globalThis.pliantPage.state.name === 'moves' && globalThis.pliantPage.state.time > 0.6);
    const eyeOf = (): Promise<number> => tab.page.evaluate(() => globalThis.pliantPage.viewpoint().eye[0]);
    expect(await eyeOf()).toBeCloseTo(3, 3);
    await tab.page.keyboard.press('r');
    await until(tab, () => globalThis.pliantPage.state.time < 0.3 && globalThis.pliantPage.viewpoint().eye[0] < 2.9);
    await tab.page.keyboard.press('Space');
    await tab.page.mouse.move(30, 400);
    await tab.page.mouse.down();
    await tab.page.mouse.move(200, 400, { steps: 5 });
    await tab.page.mouse.up();
    const turned = await eyeOf();
    await tab.page.keyboard.press('Space');
    await until(tab, () => globalThis.pliantPage.state.time > 0.6);
    expect(await eyeOf()).toBe(turned);
    await tab.page.keyboard.press('f');
    expect(await eyeOf()).toBeCloseTo(3, 3);
  });

  it('changes materials and options in the panel', async () => {
    const tab = await open('#scene=towel');
    await tab.page.locator('#panel select').first().selectOption('silk');
    await until(tab, () => globalThis.pliantPage.state.panel?.materials[0]?.material === 'silk');
    expect(await tab.page.locator('#undo').getAttribute('title')).toContain('silk');
    await tab.page.locator('#panel summary', { hasText: 'Solver' }).click();
    const field = tab.page.locator('.row', { hasText: /^iterations/ }).locator('input[type=number]');
    await field.fill('11');
    await field.press('Enter');
    await until(tab, () => globalThis.pliantPage.state.panel?.parameters.some((each) => each.option === 'iterations' && each.value[0] === 11) ?? false);
    await field.fill('-4');
    await field.press('Enter');
    await tab.page.waitForTimeout(300);
    expect(await messagesOf(tab)).toContain('iterations');
    expect(await field.inputValue()).toBe('11');
  });

  it('drags a slider as one change', async () => {
    const tab = await open('#scene=turning_ball');
    await tab.page.locator('#panel summary', { hasText: 'Solver' }).click();
    const slider = tab.page.locator('.row', { hasText: /^iterations/ }).locator('input[type=range]');
    await slider.scrollIntoViewIfNeeded();
    const box = await slider.boundingBox();
    if (box === null) throw new Error('no slider');
    await tab.page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await tab.page.mouse.down();
    await tab.page.mouse.move(box.x + box.width * 0.75, box.y + box.height / 2, { steps: 6 });
    await tab.page.mouse.up();
    await until(tab, () => globalThis.pliantPage.state.panel?.undoneNext === 'iterations');
    await tab.page.keyboard.press('Control+z');
    await until(tab, () => globalThis.pliantPage.state.panel?.undoneNext === '');
  });

  it('shares what was changed by a link', async () => {
    const tab = await open('#scene=turning_ball');
    await stopAtStart(tab);
    await tab.page.locator('#share').click();
    await until(tab, () => location.hash === '#scene=turning_ball');
    await tab.page.locator('#panel select').first().selectOption('felt');
    await until(tab, () => globalThis.pliantPage.state.panel?.hasChanges ?? false);
    await tab.page.locator('#share').click();
    await until(tab, () => location.hash.includes('text='));
    const link = await tab.page.evaluate(() => navigator.clipboard.readText());
    expect(link).toBe(tab.page.url());
    const other = await open(new URL(link).hash);
    expect(await other.page.evaluate(() => globalThis.pliantPage.state.panel?.materials[0]?.material)).toBe('felt');
    expect(await other.page.title()).toContain('turning ball');
  });

  it('tells that a link is damaged, and opens the first scene', async () => {
    const tab = await open('#name=x&text=AAAA_');
    expect(await messagesOf(tab)).toContain('damaged');
    const none = await open('#scene=no_such');
    expect(await messagesOf(none)).toContain("no built-in scene 'no_such'");
  });

  it('adds a wind', async () => {
    const tab = await open('#scene=torus');
    await tab.page.locator('button', { hasText: 'Add wind' }).click();
    await until(tab, () => globalThis.pliantPage.state.panel?.parameters.some((each) => each.key.startsWith('force:wind')) ?? false);
  });

  it('opens meshes and scenes of one\'s own, and tells what is wrong with a broken one', async () => {
    const tab = await open();
    const rows = Array.from({ length: 21 }, (_, j) => Array.from({ length: 21 }, (_, i) => `v ${i / 20} ${j / 20} 0`)).flat();
    const faces = Array.from({ length: 400 }, (_, f) => {
      const at = Math.floor(f / 20) * 21 + (f % 20) + 1;
      return `f ${at} ${at + 1} ${at + 22} ${at + 21}`;
    });
    const files = tab.page.locator('#files');
    await files.setInputFiles({ name: 'sheet.obj', mimeType: 'text/plain', buffer: Buffer.from([...rows, ...faces].join('\n')) });
    await until(tab, () => globalThis.pliantPage.state.name === 'sheet');
    expect(await tab.page.evaluate(() => globalThis.pliantPage.state.panel?.materials[0]?.material)).toBe('cotton');
    await tab.page.locator('#share').click();
    await until(tab, () => document.querySelector('#messages')?.textContent?.includes('a link cannot hold sheet.obj') ?? false);
    await files.setInputFiles({ name: 'broken.obj', mimeType: 'text/plain', buffer: Buffer.from('v 0 0 0\nf 1 2 3\n') });
    await until(tab, () => document.querySelector('#messages')?.textContent?.includes('broken.obj:2:') ?? false);
    expect(await tab.page.evaluate(() => globalThis.pliantPage.state.name)).toBe('sheet');
    await files.setInputFiles({ name: 'photo.png', mimeType: 'image/png', buffer: Buffer.from('no') });
    await until(tab, () => document.querySelector('#messages')?.textContent?.includes('photo.png: neither a scene') ?? false);
  });

  it('gives up what takes too long to open, and goes back', async () => {
    const tab = await open('#scene=flag');
    const huge = { pliant: 1, bodies: [{ name: 'cloth', mesh: { shape: 'grid', columns: 1200, rows: 1200 }, material: 'cotton' }] };
    await tab.page.locator('#files').setInputFiles({ name: 'huge.json', mimeType: 'application/json', buffer: Buffer.from(JSON.stringify(huge)) });
    await tab.page.locator('#give-up').click();
    await tab.page.locator('#loading').waitFor({ state: 'hidden' });
    const before = await tab.page.evaluate(() => globalThis.pliantPage.state.pictures);
    await tab.page.waitForFunction((count) => globalThis.pliantPage.state.pictures > count + 3, before);
    expect(await tab.page.evaluate(() => globalThis.pliantPage.state.name)).toBe('flag');
  });

  it('keeps nothing of earlier scenes on the graphics card', async () => {
    const tab = await open('#scene=flag');
    const show = async (name: string): Promise<unknown> => {
      await tab.page.evaluate((scene) => { location.hash = `#scene=${scene}`; }, name);
      await tab.page.waitForFunction((scene) => globalThis.pliantPage.state.name === scene, name);
      const before = await tab.page.evaluate(() => globalThis.pliantPage.state.pictures);
      await tab.page.waitForFunction((count) => globalThis.pliantPage.state.pictures > count + 1, before);
      return tab.page.evaluate(() => globalThis.pliantPage.memory());
    };
    await show('slope');
    const first = await show('flag');
    for (let i = 0; i < 3; ++i) {
      await show('slope');
      expect(await show('flag')).toEqual(first);
    }
  });

  it('saves a scene that it opens again', async () => {
    const tab = await open('#scene=towel');
    await tab.page.locator('#panel select').first().selectOption('denim');
    await until(tab, () => globalThis.pliantPage.state.panel?.hasChanges ?? false);
    const coming = tab.page.waitForEvent('download');
    await tab.page.keyboard.press('Control+s');
    const saved = await coming;
    expect(saved.suggestedFilename()).toBe('towel.json');
    const buffer = await readFile(await saved.path());
    await tab.page.locator('#files').setInputFiles({ name: 'mine.json', mimeType: 'application/json', buffer });
    await until(tab, () => globalThis.pliantPage.state.name === 'mine');
    expect(await tab.page.evaluate(() => globalThis.pliantPage.state.panel?.materials[0]?.material)).toBe('denim');
  });

  it('shows its picture again after the graphics driver lost it', async () => {
    const tab = await open();
    await stopAtStart(tab);
    await tab.page.addStyleTag({ content: 'body > :not(canvas) { visibility: hidden; }' });
    const before = await tab.page.screenshot();
    await tab.page.evaluate(() => {
      const lose = document.querySelector('canvas')?.getContext('webgl2')?.getExtension('WEBGL_lose_context');
      Object.assign(globalThis, { lose });
      lose?.loseContext();
    });
    await tab.page.waitForTimeout(500);
    expect(await difference(tab, before, await tab.page.screenshot())).toBeGreaterThan(3);
    await tab.page.evaluate(() => (globalThis as unknown as { lose: WEBGL_lose_context }).lose.restoreContext());
    await tab.page.waitForTimeout(1500);
    expect(await difference(tab, before, await tab.page.screenshot())).toBeLessThan(0.5);
  });

  it('has room for all of it on small screens', async () => {
    for (const [width, height] of [[320, 568], [390, 844], [568, 320], [844, 390]] as const) {
      const tab = await open('#scene=sheet_metal_and_cloth', { width, height, isPhone: true });
      const boxes = await tab.page.evaluate(() => ['#choose', '#bar nav', '#time', '#hint', '#panel'].flatMap((name) => {
        const box = document.querySelector(name)?.getBoundingClientRect();
        return box === undefined || box.width === 0 ? [] : [{ name, left: box.left, right: box.right, top: box.top, bottom: box.bottom }];
      }));
      expect(boxes.map((box) => box.name)).toEqual(['#choose', '#bar nav', '#time', '#hint']);
      for (const [i, a] of boxes.entries()) {
        expect(a.left >= 0 && a.right <= width && a.top >= 0 && a.bottom <= height, `${a.name} in ${width} x ${height}`).toBe(true);
        for (const b of boxes.slice(i + 1)) {
          const areApart = a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
          expect(areApart, `${a.name} beside ${b.name} in ${width} x ${height}`).toBe(true);
        }
      }
      await tab.close();
      tabs.pop();
    }
  });

  it('works by touch on a phone', async () => {
    const tab = await open('#scene=curtain', { width: 390, height: 844, isPhone: true });
    expect(await tab.page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
    await stopAtStart(tab);
    const place = await placeOf(tab, 840);
    await tab.page.touchscreen.tap(place.x, place.y);
    await until(tab, () => globalThis.pliantPage.state.pins.length > 0 && globalThis.pliantPage.state.panel?.undoneNext === 'pin');
    const client = await tab.page.context().newCDPSession(tab.page);
    const touch = (type: string, points: { x: number; y: number }[]): Promise<unknown> =>
      client.send('Input.dispatchTouchEvent', { type: type as 'touchMove', touchPoints: points });
    const at = await placeOf(tab, 1008);
    await touch('touchStart', [at]);
    for (let i = 1; i <= 6; ++i) await touch('touchMove', [{ x: at.x + 8 * i, y: at.y }]);
    await until(tab, () => globalThis.pliantPage.state.isPulling);
    await touch('touchEnd', []);
    await until(tab, () => !globalThis.pliantPage.state.isPulling);
    const two = [{ x: 150, y: 400 }, { x: 240, y: 400 }];
    const distanceOf = (): Promise<number> => tab.page.evaluate(() => {
      const { eye, target } = globalThis.pliantPage.viewpoint();
      return Math.hypot(eye[0] - target[0], eye[1] - target[1], eye[2] - target[2]);
    });
    const far = await distanceOf();
    await touch('touchStart', two);
    for (let i = 1; i <= 6; ++i) await touch('touchMove', [{ x: 150 - 10 * i, y: 400 }, { x: 240 + 10 * i, y: 400 }]);
    await touch('touchEnd', []);
    expect(await distanceOf()).toBeLessThan(0.8 * far);
  });
});
