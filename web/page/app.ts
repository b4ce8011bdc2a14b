// The page: a picture, a simulation beside it, and what the user does with both.
import type { Client, Listeners } from './client';
import { byId } from './dom';
import { download, readFiles, sourceOf } from './files';
import type { FirstPicture } from './first_picture';
import { firstScene, sourceOfName } from './gallery';
import { Hands } from './hands';
import { Loading } from './loading';
import { Messages } from './messages';
import { Panel } from './panel';
import type { PanelState, Report, SceneSource, Statistics, UpAxis, Viewpoint } from './protocol';
import { SceneList } from './scene_list';
import { hashOf, longestLink, readHash } from './share';
import { addWind } from './scene_text';
import { recall, store } from './storage';
import { Stage } from './view/stage';
import { ViewSection } from './view_section';

type Of<T extends Report['type']> = Extract<Report, { type: T }>;

interface PageState {
  name: string;
  /** Simulated [s]. */
  time: number;
  isPlaying: boolean;
  isPulling: boolean;
  vertexCount: number;
  /** Vertices that are pinned. */
  pins: number[];
  panel: PanelState | null;
  /** How many were drawn so far. */
  pictures: number;
}

/** [ms] */
const rateInterval = 250;
const longStep = 25;

const narrow = window.matchMedia('(max-width: 640px)');
/** The panel would cover much of the picture there, and is closed at first. */
const small = window.matchMedia('(max-width: 640px), (max-height: 480px)');
const darkScheme = window.matchMedia('(prefers-color-scheme: dark)');
const hint = narrow.matches || window.matchMedia('(pointer: coarse)').matches
  ? 'Drag anything to pull it, tap it to pin it; drag the background to look around.'
  : 'Drag anything to pull it, click it to pin it; drag the background to look around.';

export class App {
  private readonly canvas = byId('picture', HTMLCanvasElement);
  private readonly stage = new Stage(this.canvas);
  private readonly loading = new Loading(() => this.giveUp());
  private readonly messages = new Messages(byId('messages', HTMLDivElement));
  private readonly panelBox = byId('panel', HTMLElement);
  private readonly playButton = byId('play', HTMLButtonElement);
  private readonly listeners: Listeners = {
    ready: (report) => {
      this.scenes.fill(report.scenes);
      this.view.fill(report.colors);
    },
    opened: (report) => this.opened(report),
    look: (report) => this.stage.show(report.look, true),
    frame: (report) => this.take(report),
    panel: (report) => this.showPanel(report.panel),
    note: (report) => this.messages.note(report.text),
    error: (report) => this.failed(report),
  };
  private readonly hands = new Hands(this.canvas, this.stage, (command) => this.client.send(command), () => this.used());
  private readonly view = new ViewSection({
    color: (map) => {
      if (map !== null) this.stage.setColors(map);
      this.color = map?.name ?? 'none';
      this.client.send({ type: 'color', name: this.color });
    },
    wireframe: (on) => this.stage.setWireframe(on),
  });
  private readonly panel = new Panel(this.panelBox, this.view.element, {
    set: (key, value, goesOn) => this.client.send({ type: 'set', key, value, goesOn }),
    setMaterial: (body, material) => this.client.send({ type: 'setMaterial', body, material }),
    addWind: () => void this.guard(() => this.addWind()),
  });
  private readonly scenes = new SceneList((name) => this.openNamed(name), (files) => void this.guard(() => this.openFiles(files)));

  /** What the page shows now, for the console and for tests. */
  readonly state: PageState = { name: '', time: 0, isPlaying: true, isPulling: false, vertexCount: 0,
                                pins: [], panel: null, pictures: 0 };

  private hasOpened = false;
  /** What colors show. */
  private color = 'none';
  private source: SceneSource = sourceOfName(firstScene);
  /** What was asked for and has not come yet, by the number of the command. */
  private readonly opening = new Map<number, { source: SceneSource; hash: string | null }>();
  private lastOpening = 0;
  /** What was to be opened at first could not be: it was the first scene then, once. */
  private hasFallenBack = false;
  private hasNews = false;
  /** Whether it goes on when the page is seen again. */
  private plays = true;
  /** The frame behind the one that has come last. */
  private isAskedFor = false;
  private lastPicture = 0;
  private rateAt = -Infinity;
  private pictures: number[] = [];

  /** The first picture is shown, and nothing is open yet. */
  private isFirstPicture = false;
  /** A picture of the simulation has been drawn. */
  private hasMoved = false;

  /** first: what is drawn until the simulation is there. */
  constructor(private readonly client: Client, private readonly first: Promise<FirstPicture | null>) {}

  start(): void {
    this.client.listen(this.listeners);
    this.setTheme(recall('theme') ?? (darkScheme.matches ? 'dark' : 'light'));
    this.showPanelBox(!small.matches);
    this.connectButtons();
    this.connectKeys();
    this.connectDrop();
    small.addEventListener('change', () => this.showPanelBox(!small.matches));
    document.addEventListener('visibilitychange', () => this.rest());
    this.stage.onLost = () => this.messages.note('The picture was lost by the graphics driver; it comes back by itself.');
    window.addEventListener('hashchange', () => void this.guard(() => this.openAddress()));
    void this.guard(async () => {
      await this.openAddress();
      await this.showFirst();
    });
    requestAnimationFrame((now) => this.draw(now));
  }

  /** Where a vertex is in the picture, in CSS pixels from its corner. */
  placeOf(vertex: number): { x: number; y: number } {
    return this.stage.placeOf(vertex);
  }

  /** What the graphics card holds of it. */
  memory(): { geometries: number; textures: number; programs: number } {
    return this.stage.memory;
  }

  /** Of all scenes that the page offers. */
  sceneNames(): string[] {
    return this.scenes.names();
  }

  viewpoint(): Viewpoint {
    return this.stage.viewpoint();
  }

  // ---- scenes

  /** It can be looked at from all sides; what is done to its bodies begins with the simulation. */
  private async showFirst(): Promise<void> {
    const first = await this.first;
    const isAskedFor = this.lastOpening === 1 && this.opening.get(1)?.source.name === first?.name;
    if (first === null || this.hasOpened || !isAskedFor) return;
    this.isFirstPicture = true;
    this.stage.show(first.look, false);
    this.stage.update(first.frame);
    this.stage.canPick = false;
    this.tell(first.name, first.description);
  }

  private tell(name: string, description: string): void {
    const title = name.replaceAll('_', ' ');
    byId('scene-name', HTMLSpanElement).textContent = title;
    byId('description', HTMLParagraphElement).textContent = description;
    document.title = `${title} · Pliant`;
  }

  private async openAddress(): Promise<void> {
    let shared = null;
    const ticket = this.lastOpening;
    try {
      shared = await readHash(location.hash);
    } catch (error) {
      if (!this.hasOpened) this.open(sourceOfName(firstScene), null);
      throw error;
    }
    if (ticket !== this.lastOpening) return;
    if (shared === null) return this.open(sourceOfName(firstScene), null);
    this.open(shared.kind === 'builtin' ? sourceOfName(shared.name)
                                        : { kind: 'text', text: shared.text, name: shared.name, files: [] }, null);
  }

  /** hash: of the address from then on; null: as it is. */
  private open(source: SceneSource, hash: string | null): void {
    const id = ++this.lastOpening;
    this.opening.set(id, { source, hash });
    this.messages.clear();
    this.loading.begin(source.name);
    const aspect = this.canvas.clientWidth / Math.max(this.canvas.clientHeight, 1);
    this.client.send({ type: 'open', id, source, aspect: Math.max(aspect, 1.2) });
  }

  private openNamed(name: string): void {
    this.open(sourceOfName(name), `#scene=${encodeURIComponent(name)}`);
  }

  private async openFiles(files: File[], up: UpAxis = 'z'): Promise<void> {
    const ticket = this.lastOpening;
    const source = sourceOf(await readFiles(files), up);
    if (ticket === this.lastOpening) this.open(source, '#');
  }

  private opened(report: Of<'opened'>): void {
    const { source, hash } = this.opening.get(report.id) ?? { source: this.source, hash: null };
    this.source = source;
    this.opening.delete(report.id);
    this.client.shown = report.id;
    this.hasOpened = true;
    if (this.opening.size === 0) this.loading.end();
    if (hash !== null) history.replaceState(null, '', hash === '#' ? location.pathname + location.search : hash);
    this.state.name = (source.kind === 'builtin' ? source.name : report.name) || 'scene';
    this.state.vertexCount = report.look.vertexCount;
    this.hands.cancel();
    // Where the user has turned the first picture, it stays as it is.
    this.stage.show(report.look, this.isFirstPicture && report.id === 1);
    this.stage.canPick = true;
    this.isFirstPicture = false;
    this.panel.reset();
    this.showPanel(report.panel);
    this.tell(this.state.name, report.description);
    for (const warning of report.warnings) this.messages.note(warning);
    if (recall('used') === null) this.showHint(hint);
    if (source.kind === 'mesh') this.offerUp(source);
  }

  /** Which axis of a mesh points up nobody knows but its owner. */
  private offerUp(source: Extract<SceneSource, { kind: 'mesh' }>): void {
    const other: UpAxis = source.up === 'z' ? 'y' : 'z';
    this.messages.choice(`Its ${source.up} axis is taken as up.`, `Use ${other} as up`,
                         () => this.open({ ...source, up: other }, null));
  }

  private async addWind(): Promise<void> {
    const ticket = this.lastOpening;
    const { source } = this;
    const files = source.kind === 'builtin' ? [] : source.files;
    const text = addWind(await this.client.text());
    if (ticket === this.lastOpening) this.open({ kind: 'text', text, name: this.state.name, files }, '#');
  }

  private failed(report: Of<'error'>): void {
    if (report.command === 'open') {
      this.opening.delete(report.id ?? -1);
      if (!this.hasOpened && !this.hasFallenBack) this.open(sourceOfName(firstScene), null);
      this.hasFallenBack = true;
    }
    if (this.opening.size === 0 || report.command === 'load') this.loading.end();
    this.messages.error(report.message);
  }

  private async share(): Promise<void> {
    const needed = this.source.kind === 'builtin' ? [] : this.source.files.filter((file) => !/\.json$/i.test(file.name));
    if (needed.length > 0) {
      throw new Error(`a link cannot hold ${needed.map((file) => file.name).join(', ')}; save the scene and send the files with it`);
    }
    // Asked for first: what was changed just before is known then.
    const text = await this.client.text();
    const isNamed = this.state.panel?.hasChanges === false && this.source.kind === 'builtin';
    const hash = await hashOf(isNamed ? { kind: 'builtin', name: this.source.name }
                                      : { kind: 'text', name: this.state.name, text });
    if (hash.length > longestLink) {
      throw new Error(`the link would have ${hash.length} characters, more than programs take; save the scene and send the file`);
    }
    history.replaceState(null, '', hash);
    try {
      await navigator.clipboard.writeText(location.href);
      this.messages.note('The link is in the clipboard: it opens the scene as you have changed it, from its start.');
    } catch {
      this.messages.note('The address of this page is the link now: it opens the scene as you have changed it, from its start.');
    }
  }

  private async save(): Promise<void> {
    download(`${this.state.name}.json`, await this.client.text());
  }

  // ---- pictures

  private take(report: Of<'frame'>): void {
    this.stage.update(report.frame);
    this.view.show(report.frame.values);
    this.hasNews = true;
    // Of long steps the next one is to be seen when it ends, not the one after it.
    this.isAskedFor = report.statistics.stepMilliseconds > longStep;
    if (this.isAskedFor) this.client.send({ type: 'drawn' });
    this.state.isPlaying = report.statistics.isPlaying;
    this.state.time = report.statistics.time;
    this.state.pins = [...report.frame.pins];
    this.state.isPulling = report.frame.pull !== null;
    this.showRate(report.statistics);
  }

  /** Not with every picture, since the page would be laid out and drawn anew for it. */
  private showRate({ time, isPlaying, stepMilliseconds, speed }: Statistics): void {
    const now = performance.now();
    const isAsBefore = this.playButton.classList.contains('paused') !== isPlaying;
    if (isPlaying && isAsBefore && now - this.rateAt < rateInterval) return;
    this.rateAt = now;
    this.playButton.classList.toggle('paused', !isPlaying);
    this.playButton.ariaLabel = isPlaying ? 'Pause' : 'Play';
    this.playButton.title = `${this.playButton.ariaLabel} (Space)`;
    const pace = !isPlaying ? 'paused' : speed > 0.97 ? 'real time' : `${speed.toFixed(2)} × real time`;
    const text = `${time.toFixed(2)} s · ${pace}`;
    const rate = byId('rate', HTMLOutputElement);
    if (rate.value !== text) rate.value = text;
    rate.title = `${stepMilliseconds.toFixed(1)} ms a step, ${this.picturesPerSecond()} pictures a second, quality ${this.stage.quality}`;
  }

  private draw(now: number): void {
    requestAnimationFrame((next) => this.draw(next));
    this.hands.flush();
    // Before it is drawn, so that the next frame is made meanwhile.
    if (this.hasNews && !this.isAskedFor) this.client.send({ type: 'drawn' });
    const hasDrawn = this.stage.draw();
    if (hasDrawn && this.isFirstPicture && this.state.pictures === 0) this.countPicture(now);
    if (!this.hasNews) return;
    this.hasNews = false;
    if (!hasDrawn) return;
    if (now - this.lastPicture < 1000) this.stage.noteInterval(now - this.lastPicture);
    this.lastPicture = now;
    this.countPicture(now);
  }

  private countPicture(now: number): void {
    if (this.state.pictures === 0) performance.mark('first picture');
    if (!this.isFirstPicture && !this.hasMoved) performance.mark('simulation');
    this.hasMoved = !this.isFirstPicture;
    this.state.pictures += 1;
    this.pictures = [...this.pictures.filter((at) => now - at < 1000), now];
  }

  private picturesPerSecond(): number {
    return this.pictures.length;
  }

  // ---- panel, buttons, keys

  private showPanel(state: PanelState): void {
    this.panel.show(state);
    this.state.panel = state;
    const label = (id: string, what: string, keys: string, next: string): void => {
      const button = byId(id, HTMLButtonElement);
      button.disabled = next === '';
      button.title = next === '' ? `${what} (${keys})` : `${what} ${next} (${keys})`;
    };
    label('undo', 'Undo', 'Ctrl Z', state.undoneNext);
    label('redo', 'Redo', 'Ctrl Shift Z', state.redoneNext);
  }

  private showPanelBox(on: boolean): void {
    this.panelBox.hidden = !on;
    if (on && small.matches) byId('hint', HTMLParagraphElement).hidden = true;  // it lies over the panel there
    byId('panel-toggle', HTMLButtonElement).ariaExpanded = String(on);
    this.stage.setInset(on && !narrow.matches ? this.panelBox.offsetWidth + 12 : 0);
  }

  private setTheme(theme: string): void {
    document.documentElement.dataset['theme'] = theme;
    this.stage.setDark(theme === 'dark');
  }

  private toggleTheme(): void {
    const theme = document.documentElement.dataset['theme'] === 'dark' ? 'light' : 'dark';
    store('theme', theme);
    this.setTheme(theme);
  }

  private restart(): void {
    this.hands.cancel();
    this.client.send({ type: 'restart', keeps: true });
  }

  private togglePlay(): void {
    this.state.isPlaying = !this.state.isPlaying;
    this.client.send({ type: 'play', on: this.state.isPlaying });
  }

  /** What nobody sees stands still. */
  private rest(): void {
    if (document.hidden) {
      this.plays = this.state.isPlaying;
      this.client.send({ type: 'play', on: false });
    } else if (this.plays) {
      this.client.send({ type: 'play', on: true });
    }
  }

  /** Ends what takes too long, and goes back to the scene before. */
  private giveUp(): void {
    this.client.renew();
    this.client.send({ type: 'color', name: this.color });
    this.opening.clear();
    this.hands.cancel();
    if (this.hasOpened) this.open(this.source, null);
    else this.loading.end();
  }

  private used(): void {
    store('used', 'yes');
    byId('hint', HTMLParagraphElement).hidden = true;
  }

  private showHint(text: string): void {
    const box = byId('hint', HTMLParagraphElement);
    box.textContent = text;
    box.hidden = false;
  }

  private connectButtons(): void {
    const on = (id: string, act: () => void | Promise<void>): void => {
      byId(id, HTMLButtonElement).addEventListener('click', () => void this.guard(async () => act()));
    };
    on('choose', () => this.scenes.show());
    on('undo', () => this.client.send({ type: 'undo' }));
    on('redo', () => this.client.send({ type: 'redo' }));
    on('share', () => this.share());
    on('save', () => this.save());
    on('theme', () => this.toggleTheme());
    on('panel-toggle', () => this.showPanelBox(this.panelBox.hidden !== false));
    on('restart', () => this.restart());
    on('play', () => this.togglePlay());
    on('step', () => this.client.send({ type: 'step' }));
  }

  private connectKeys(): void {
    const keys: Record<string, () => void> = {
      ' ': () => this.togglePlay(),
      s: () => this.client.send({ type: 'step' }),
      r: () => this.restart(),
      f: () => this.stage.frame(),
      o: () => this.scenes.show(),
      t: () => this.toggleTheme(),
      c: () => this.view.nextColor(),
      w: () => this.view.toggleWireframe(),
      p: () => this.showPanelBox(this.panelBox.hidden !== false),
      'ctrl z': () => this.client.send({ type: 'undo' }),
      'ctrl shift z': () => this.client.send({ type: 'redo' }),
      'ctrl y': () => this.client.send({ type: 'redo' }),
      'ctrl s': () => void this.guard(() => this.save()),
    };
    window.addEventListener('keydown', (event) => {
      const target = event.target as HTMLElement;
      if (target.closest('input[type="number"], input[type="search"], select, dialog') !== null || (event.key === ' ' && target.closest('button, summary, input[type="checkbox"]') !== null)) return;
      const isCommand = event.ctrlKey || event.metaKey;
      const name = `${isCommand ? 'ctrl ' : ''}${isCommand && event.shiftKey ? 'shift ' : ''}${event.key.toLowerCase()}`;
      const act = keys[name];
      if (act === undefined || event.altKey) return;
      event.preventDefault();
      act();
    });
  }

  private connectDrop(): void {
    const box = byId('drop', HTMLDivElement);
    window.addEventListener('dragover', (event) => {
      event.preventDefault();
      box.hidden = false;
    });
    window.addEventListener('dragleave', (event) => {
      if (event.relatedTarget === null) box.hidden = true;
    });
    window.addEventListener('drop', (event) => {
      event.preventDefault();
      box.hidden = true;
      const files = [...(event.dataTransfer?.files ?? [])];
      if (files.length > 0) void this.guard(() => this.openFiles(files));
    });
  }

  /** Does it, and tells what went wrong. */
  private async guard(act: () => Promise<void>): Promise<void> {
    try {
      await act();
    } catch (error) {
      this.messages.error(error instanceof Error ? error.message : String(error));
    }
  }
}
