// The simulation as the worker runs it, with the real module, in node.
import { afterEach, describe, expect, it } from 'vitest';
import { loadPliant, type Pliant } from 'pliant';
import type { Command, Report } from '../page/protocol';
import { Simulator } from '../page/simulator';

const pliant: Pliant = await loadPliant();

/** A page that draws each frame as soon as it comes. */
class Page {
  readonly reports: Report[] = [];
  private readonly simulator = new Simulator(pliant, (report) => {
    this.reports.push(report);
    if (report.type === 'frame' && this.draws) queueMicrotask(() => this.command({ type: 'drawn' }));
  });

  constructor(private readonly draws = true) {}

  /** scene: as the page's client adds it. */
  command(command: Command, scene?: number): void {
    this.simulator.command(command, scene);
  }

  open(name = 'flag'): void {
    this.command({ type: 'open', id: 1, source: { kind: 'builtin', name }, aspect: 1.5 });
  }

  all<T extends Report['type']>(type: T): Extract<Report, { type: T }>[] {
    return this.reports.filter((report): report is Extract<Report, { type: T }> => report.type === type);
  }

  async until(isThere: () => boolean): Promise<void> {
    for (let i = 0; i < 500 && !isThere(); ++i) await new Promise((resolve) => setTimeout(resolve, 10));
    expect(isThere(), `it came, after ${this.reports.map((report) => report.type).join(' ')}`).toBe(true);
  }

  /** The newest frame. */
  frame(): Extract<Report, { type: 'frame' }> {
    const last = this.all('frame').at(-1);
    if (last === undefined) throw new Error('no frame');
    return last;
  }
}

const pages: Page[] = [];
const page = (draws = true): Page => {
  const made = new Page(draws);
  pages.push(made);
  return made;
};
afterEach(() => {
  for (const each of pages.splice(0)) each.command({ type: 'play', on: false });
});

describe('a scene in the worker', () => {
  it('runs in real time', async () => {
    const tab = page();
    tab.open();
    await tab.until(() => tab.all('frame').length > 0 && tab.frame().statistics.time >= 1);
    expect(tab.frame().statistics.speed).toBeGreaterThan(0.5);
    expect(tab.frame().statistics.speed).toBeLessThan(1.2);
    expect(tab.frame().frame.positions.every(Number.isFinite)).toBe(true);
  });

  it('sends one frame at a time', async () => {
    const tab = page(false);
    tab.open();
    await tab.until(() => tab.all('frame').length > 0);
    await new Promise((resolve) => setTimeout(resolve, 200));
    expect(tab.all('frame')).toHaveLength(1);
    tab.command({ type: 'drawn' });
    await tab.until(() => tab.all('frame').length === 2);
    expect(tab.frame().statistics.time).toBeGreaterThan(0.1);
  });

  it('pauses, takes single steps, and starts over', async () => {
    const tab = page();
    tab.open();
    tab.command({ type: 'play', on: false });
    tab.command({ type: 'step' });
    tab.command({ type: 'step' });
    await tab.until(() => tab.all('frame').length > 0 && tab.frame().statistics.time > 1.5 / 60);
    expect(tab.frame().statistics).toMatchObject({ isPlaying: false, speed: 0 });
    expect(tab.frame().statistics.time).toBeCloseTo(2 / 60);
    tab.command({ type: 'restart', keeps: true });
    await tab.until(() => tab.frame().statistics.time === 0);
    expect(tab.all('look')).toHaveLength(1);
  });

  it('pulls, pins and takes back', async () => {
    const tab = page();
    tab.open();
    tab.command({ type: 'grab', point: { vertices: [400, 400, 400], weights: [1, 0, 0] }, to: [0, -1, 1] });
    await tab.until(() => tab.all('frame').length > 0 && tab.frame().frame.pull !== null);
    expect(tab.frame().frame.pull?.to).toEqual([0, -1, 1]);
    tab.command({ type: 'letGo' });
    tab.command({ type: 'pin', vertex: 400 });
    await tab.until(() => tab.frame().frame.pins.includes(400));
    expect(tab.all('panel').at(-1)?.panel).toMatchObject({ undoneNext: 'pin', hasChanges: true });
    tab.command({ type: 'undo' });
    await tab.until(() => !tab.frame().frame.pins.includes(400));
    expect(tab.all('panel').at(-1)?.panel).toMatchObject({ redoneNext: 'pin', hasChanges: false });
  });

  it('goes on with the scene before when another cannot be opened', async () => {
    const tab = page();
    tab.open();
    tab.command({ type: 'open', id: 1, source: { kind: 'builtin', name: 'no such' }, aspect: 1 });
    expect(tab.all('error')).toEqual([{ type: 'error', message: "there is no built-in scene 'no such'", command: 'open', id: 1 }]);
    const bytes = new TextEncoder().encode('v 0 0 0\nv 1 0 0\nf 1 2 9\n');
    tab.command({ type: 'open', id: 1, source: { kind: 'mesh', name: 'broken.obj', files: [{ name: 'broken.obj', bytes }], up: 'z' }, aspect: 1 });
    expect(tab.all('error').at(-1)?.message).toMatch(/broken\.obj:3: /);
    await tab.until(() => tab.all('frame').length > 0 && tab.frame().statistics.time > 0.1);
    expect(tab.all('opened')).toHaveLength(1);
  });

  it('opens a mesh, and gives the scene it makes of it', async () => {
    const tab = page();
    const bytes = new TextEncoder().encode('v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 2 3 4\n');
    tab.command({ type: 'open', id: 1, source: { kind: 'mesh', name: 'cloth.obj', files: [{ name: 'cloth.obj', bytes }], up: 'z' }, aspect: 1 });
    expect(tab.all('opened')[0]?.panel.materials[0]).toMatchObject({ body: 'cloth', material: 'cotton' });
    tab.command({ type: 'setMaterial', body: 'cloth', material: 'silk' });
    tab.command({ type: 'text', id: 7 });
    const report = tab.all('text')[0];
    expect(report?.id).toBe(7);
    expect(report?.text).toContain('silk');
    expect(report?.text).toContain('cloth.obj');
  });

  it('starts over with a mesh that is still there, whatever was opened in between', async () => {
    const tab = page();
    const bytes = new TextEncoder().encode('v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 2 3 4\n');
    const broken = new TextEncoder().encode('f 1 2 3\n');
    const source = (name: string, content: Uint8Array): Command =>
      ({ type: 'open', id: 1, source: { kind: 'mesh', name, files: [{ name, bytes: content }], up: 'z' }, aspect: 1 });
    for (let i = 0; i < 3; ++i) tab.command(source('cloth.obj', bytes));
    tab.command(source('cloth.obj', broken));
    expect(tab.all('error')).toHaveLength(1);
    tab.command({ type: 'restart', keeps: true });
    expect(tab.all('error')).toHaveLength(1);
    expect(tab.all('look')).toHaveLength(1);
    tab.open();
    expect(tab.all('opened')).toHaveLength(4);
  });

  it('tells the panel what is out of range, and leaves it as it was', async () => {
    const tab = page();
    tab.open();
    const key = tab.all('opened')[0]?.panel.parameters.find((each) => each.option === 'iterations')?.key ?? '';
    tab.command({ type: 'set', key, value: [-3], goesOn: false });
    expect(tab.all('error').at(-1)?.message).toMatch(/iterations/);
    tab.command({ type: 'set', key, value: [7], goesOn: false });
    const changed = tab.all('panel').at(-1)?.panel.parameters.find((each) => each.key === key);
    expect(changed?.value).toEqual([7]);
  });

  it('drops what was meant for the scene before', async () => {
    const tab = page();
    tab.open();
    tab.command({ type: 'pin', vertex: 400 }, 0);
    tab.command({ type: 'text', id: 5 }, 0);
    await tab.until(() => tab.all('frame').length > 0);
    expect(tab.frame().frame.pins).not.toContain(400);
    expect(tab.all('error')).toEqual([{ type: 'error', message: 'another scene was opened in between', command: 'text', id: 5 }]);
  });

  it('shows what stands again when a value is refused', () => {
    const tab = page();
    tab.open();
    const panels = tab.all('panel').length;
    const key = tab.all('opened')[0]?.panel.parameters.find((each) => each.option === 'iterations')?.key ?? '';
    tab.command({ type: 'set', key, value: [-3], goesOn: false });
    expect(tab.all('panel').length).toBe(panels + 1);
  });

  it('tells that nothing is open yet', () => {
    const tab = page();
    tab.command({ type: 'letGo' });
    expect(tab.all('error')).toHaveLength(1);
  });
});
