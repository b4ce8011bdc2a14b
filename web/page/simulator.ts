// A scene that runs in real time: what the page commands, when steps are due, what is told of it.
import type { Pliant, Scene } from 'pliant';
import { Meter } from './meter';
import { Pacer } from './pacer';
import type { Command, Frame, PanelState, Report, SceneLook, SceneSource } from './protocol';

type Send = (report: Report, transfer?: Transferable[]) => void;
type Of<T extends Command['type']> = Extract<Command, { type: T }>;

/** The values of the scene's events show in the panel that often [ms]. */
const panelInterval = 250;

function arraysOf(of: Frame | SceneLook): Transferable[] {
  const lists: unknown[] = Object.values(of);
  return lists.flatMap((list) => (ArrayBuffer.isView(list) ? [list.buffer as ArrayBuffer] : []));
}

function messageOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
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
  private opened = 0;
  private colliders: number[] = [];
  private rebuilds = 0;
  private note = '';
  private panelText = '';
  private panelAt = 0;
  /** Something has changed that the page has not been told. */
  private isDirty = false;
  private pageIsFree = true;

  constructor(private readonly pliant: Pliant, private readonly send: Send,
              private readonly now: () => number = () => performance.now()) {
    this.soon.port1.onmessage = () => this.turn();
  }

  command(command: Command): void {
    try {
      this.act(command);
    } catch (error) {
      this.send({ type: 'error', message: messageOf(error), command: command.type });
    }
    this.schedule();
  }

  private act(command: Command): void {
    switch (command.type) {
      case 'open': return this.open(command);
      case 'drawn':
        this.pageIsFree = true;
        return;
      case 'play': return this.play(command.on);
      case 'text': return this.send({ type: 'text', id: command.id, text: this.theScene().text() });
      case 'step':
        this.play(false);
        this.singleSteps += 1;
        return;
      default:
        this.change(this.theScene(), command);
        this.isDirty = true;
    }
  }

  private change(scene: Scene, command: Exclude<Command, Of<'open' | 'drawn' | 'play' | 'text' | 'step'>>): void {
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

  private read(source: SceneSource): Scene {
    if (source.kind === 'builtin') return this.pliant.openScene(this.pliant.builtinScene(source.name), source.name, '');
    const folder = `/opened/${++this.opened}`;
    for (const file of source.files) this.pliant.writeFile(`${folder}/${file.name}`, file.bytes);
    if (source.kind === 'mesh') return this.pliant.openMesh(`${folder}/${source.name}`, 1, source.up);
    return this.pliant.openScene(source.text, source.name, folder);
  }

  private open({ source, aspect }: Of<'open'>): void {
    const scene = this.read(source);
    this.scene?.delete();
    this.scene = scene;
    this.aspect = aspect;
    this.note = '';
    this.singleSteps = 0;
    this.startClock();
    const look = this.makeLook(scene);
    const panel = this.panel(scene);
    this.panelText = JSON.stringify(panel);
    this.send({ type: 'opened', name: scene.name(), description: scene.description(), look, panel,
                warnings: scene.warnings() }, arraysOf(look));
    this.isDirty = true;
  }

  private makeLook(scene: Scene): SceneLook {
    const look = scene.look(this.aspect);
    this.colliders = look.colliders.map((collider) => collider.number);
    this.rebuilds = scene.rebuilds();
    return look;
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
    try {
      if (this.timeToStep() <= 0) this.step(this.theScene());
      if (this.isDirty && this.pageIsFree) this.publish(this.theScene());
    } catch (error) {
      this.isPlaying = false;
      this.singleSteps = 0;
      this.send({ type: 'error', message: messageOf(error), command: 'step' });
      this.isDirty = true;
    }
    this.schedule();
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
    let frame = scene.frame();
    if (!sameNumbers(frame.colliders, this.colliders)) {
      this.sendLook(scene);
      frame = scene.frame();
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
