// A scene that runs in real time: what the page commands, when steps are due, what is told of it.
import type { Pliant, Scene } from 'pliant';
import { Meter } from './meter';
import { Pacer } from './pacer';
import type { Command, Frame, PanelState, Report, SceneLook, SceneSource } from './protocol';

type Send = (report: Report, transfer?: Transferable[]) => void;
type Of<T extends Command['type']> = Extract<Command, { type: T }>;

/** The values of the scene's events show in the panel that often [ms]. */
const panelInterval = 250;
/** A key that is held down asks for more than can be taken. */
const mostSingleSteps = 2;

function arraysOf(of: Frame | SceneLook): Transferable[] {
  const lists: unknown[] = [...Object.values(of), 'values' in of ? of.values?.numbers : undefined];
  return lists.flatMap((list) => (ArrayBuffer.isView(list) ? [list.buffer as ArrayBuffer] : []));
}

/** Paths begin with the names of the user's files; what the machine says is said in words. */
function messageOf(error: unknown): string {
  const message = error instanceof Error ? error.message : String(error);
  if (/bad_alloc|out of memory|memory access|Aborted|unreachable/.test(message)) {
    return 'there is not enough memory for this scene; reload the page, and open a smaller one';
  }
  return message.replaceAll(/\/opened\/\d+\//g, '');
}

function sameNumbers(a: readonly number[], b: readonly number[]): boolean {
  return a.length === b.length && a.every((number, i) => number === b[i]);
}

export class Simulator {
  private scene: Scene | null = null;
  private aspect = 1.5;
  private isPlaying = true;
  private singleSteps = 0;
  private readonly pacer = new Pacer();
  private readonly meter = new Meter();
  private readonly soon = new MessageChannel();
  private timer: ReturnType<typeof setTimeout> | undefined;
  private isScheduled = false;
  /** Of the `open` that it came from. */
  private id = 0;
  private opened = 0;
  /** Of the scene's own files. */
  private folder = '/opened/0';
  private colliders: number[] = [];
  private rebuilds = 0;
  private note = '';
  /** What colors show, from scene to scene. */
  private color = 'none';
  private panelText = '';
  private panelAt = 0;
  /** Something has changed that the page has not been told. */
  private isDirty = false;
  private pageIsFree = true;
  private isFirst = false;

  constructor(private readonly pliant: Pliant, private readonly send: Send,
              private readonly now: () => number = () => performance.now()) {
    this.soon.port1.onmessage = () => this.turn();
  }

  /** scene: see Letter; without it the one that is open is meant. */
  command(command: Command, scene = this.id): void {
    try {
      if (scene === this.id || command.type === 'open' || command.type === 'drawn' || command.type === 'play' || command.type === 'color') this.act(command);
      else if (command.type === 'text') throw new Error('another scene was opened in between');
    } catch (error) {
      const id = command.type === 'open' || command.type === 'text' ? { id: command.id } : {};
      this.send({ type: 'error', message: messageOf(error), command: command.type, ...id });
      // The panel has a value that was refused.
      if (command.type === 'set' && this.scene !== null) {
        this.panelText = '';
        this.tellPanel();
      }
    }
    this.schedule();
  }

  private act(command: Command): void {
    switch (command.type) {
      case 'open': return this.open(command);
      case 'drawn':
        this.pageIsFree = true;
        return;
      case 'color':
        this.color = command.name;
        this.isDirty = true;
        return;
      case 'play':
        if (this.scene !== null) this.play(command.on);
        return;
      case 'text': return this.send({ type: 'text', id: command.id, text: this.theScene().text() });
      case 'step':
        if (this.scene === null) return;
        this.play(false);
        this.singleSteps = Math.min(this.singleSteps + 1, mostSingleSteps);
        return;
      default:
        this.change(this.theScene(), command);
        this.isDirty = true;
    }
  }

  private change(scene: Scene, command: Exclude<Command, Of<'open' | 'drawn' | 'color' | 'play' | 'text' | 'step'>>): void {
    switch (command.type) {
      case 'restart': return this.restart(scene, command.keeps);
      case 'grab': return scene.grab(command.point.vertices, command.point.weights, ...command.to, 0);
      case 'pullTo': return scene.pullTo(...command.to);
      case 'letGo': return scene.letGo();
      case 'movePin': return scene.movePin(command.vertex, ...command.to);
      case 'moveCollider': return scene.moveCollider(command.number, ...command.to);
      case 'dropCollider': return scene.dropCollider(command.number);
      case 'pin': scene.pin(command.vertex); break;
      case 'unpin': scene.unpin(command.vertex); break;
      case 'dropPin': scene.dropPin(command.vertex); break;
      case 'set': {
        const [x = 0, y = 0, z = 0] = command.value;
        scene.set(command.key, x, y, z, command.goesOn);
        break;
      }
      case 'setMaterial': scene.setMaterial(command.body, command.material); break;
      case 'undo': scene.undo(); break;
      case 'redo': scene.redo(); break;
    }
    this.tellPanel();
  }

  private theScene(): Scene {
    if (this.scene === null) throw new Error('no scene is open');
    return this.scene;
  }

  /** Files of its own are put into the folder. */
  private read(source: SceneSource, folder: string): Scene {
    if (source.kind === 'builtin') return this.pliant.openScene(this.pliant.builtinScene(source.name), source.name, '');
    for (const file of source.files) this.pliant.writeFile(`${folder}/${file.name}`, file.bytes);
    if (source.kind === 'mesh') return this.pliant.openMesh(`${folder}/${source.name}`, 1, source.up);
    return this.pliant.openScene(source.text, source.name, folder);
  }

  private open({ id, source, aspect }: Of<'open'>): void {
    const folder = `/opened/${++this.opened}`;
    let scene: Scene | null = null;
    let look: SceneLook;
    let panel: PanelState;
    try {
      scene = this.read(source, folder);
      look = scene.look(aspect);
      panel = this.panel(scene);
    } catch (error) {
      scene?.delete();
      this.pliant.removeFiles(folder);
      throw error;
    }
    this.scene?.delete();
    this.pliant.removeFiles(this.folder);
    this.scene = scene;
    this.folder = folder;
    this.id = id;
    this.aspect = aspect;
    this.note = '';
    this.singleSteps = 0;
    this.startClock();
    this.remember(scene, look);
    this.isFirst = true;
    this.panelText = JSON.stringify(panel);
    this.send({ type: 'opened', id, name: scene.name(), description: scene.description(), look, panel,
                warnings: scene.warnings() }, arraysOf(look));
    this.isDirty = true;
  }

  private makeLook(scene: Scene): SceneLook {
    const look = scene.look(this.aspect);
    this.remember(scene, look);
    return look;
  }

  private remember(scene: Scene, look: SceneLook): void {
    this.colliders = look.colliders.map((collider) => collider.number);
    this.rebuilds = scene.rebuilds();
  }

  private restart(scene: Scene, keeps: boolean): void {
    scene.restart(keeps);
    this.singleSteps = 0;
    this.startClock();
    const look = this.makeLook(scene);
    this.send({ type: 'look', look }, arraysOf(look));
    this.tellPanel();
  }

  private play(on: boolean): void {
    if (on && !this.isPlaying) this.startClock();
    this.isPlaying = on;
    this.isDirty = true;
  }

  private startClock(): void {
    this.pacer.start(this.now());
    this.meter.clear();
  }

  /** Until the next step [ms]; infinite where none is due. */
  private timeToStep(): number {
    if (this.scene === null) return Infinity;
    if (this.singleSteps > 0) return 0;
    return this.isPlaying ? this.pacer.wait(this.now(), this.scene.timeStep()) : Infinity;
  }

  /** Goes on at once, but after the messages that have come in, or when the next step is due. */
  private schedule(): void {
    if (this.isScheduled) return;
    clearTimeout(this.timer);
    if (this.scene === null) return;
    const wait = this.isDirty && this.pageIsFree ? 0 : this.timeToStep();
    if (wait <= 0) {
      this.isScheduled = true;
      this.soon.port2.postMessage(null);
    } else if (wait < Infinity) {
      this.timer = setTimeout(() => this.turn(), wait);
    }
  }

  private turn(): void {
    this.isScheduled = false;
    const { scene } = this;
    if (scene === null) return;
    try {
      // What a scene looks like at its start is told before its first step, which takes longest.
      if (!this.isFirst && this.timeToStep() <= 0) this.step(scene);
    } catch (error) {
      this.stop(error);
      this.isDirty = true;
    }
    try {
      if (this.isDirty && this.pageIsFree) this.publish(scene);
    } catch (error) {
      this.stop(error);
      this.isDirty = false;
    }
    this.isFirst = false;
    this.schedule();
  }

  private stop(error: unknown): void {
    this.isPlaying = false;
    this.singleSteps = 0;
    this.send({ type: 'error', message: messageOf(error), command: 'step' });
  }

  private step(scene: Scene): void {
    const begin = this.now();
    const before = scene.time();
    scene.step();
    const end = this.now();
    this.pacer.tookStep();
    this.singleSteps = Math.max(this.singleSteps - 1, 0);
    this.meter.add(end, end - begin, scene.time() - before);
    this.isDirty = true;
  }

  private publish(scene: Scene): void {
    if (scene.rebuilds() !== this.rebuilds) this.sendLook(scene);
    let frame = scene.frame(this.color);
    if (!sameNumbers(frame.colliders, this.colliders)) {
      this.sendLook(scene);
      frame = scene.frame(this.color);
    }
    const now = this.now();
    const rates = this.isPlaying ? this.meter.rates(now) : { ...this.meter.rates(now), stepsPerSecond: 0, speed: 0 };
    this.send({ type: 'frame', frame, statistics: { ...rates, time: scene.time(), isPlaying: this.isPlaying } },
              arraysOf(frame));
    this.isDirty = false;
    this.pageIsFree = false;
    if (now - this.panelAt > panelInterval) this.tellPanel();
    const note = scene.note();
    if (note !== this.note && note !== '') this.send({ type: 'note', text: note });
    this.note = note;
  }

  private sendLook(scene: Scene): void {
    const look = this.makeLook(scene);
    this.send({ type: 'look', look }, arraysOf(look));
  }

  private panel(scene: Scene): PanelState {
    return { parameters: scene.parameters(), materials: scene.materials(), undoneNext: scene.undoneNext(),
             redoneNext: scene.redoneNext(), hasChanges: scene.hasChanges() };
  }

  private tellPanel(): void {
    const scene = this.theScene();
    this.panelAt = this.now();
    const panel = this.panel(scene);
    const text = JSON.stringify(panel);
    if (text === this.panelText) return;
    this.panelText = text;
    this.send({ type: 'panel', panel });
  }
}
