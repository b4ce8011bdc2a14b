// What mouse and fingers do in the picture: turn the camera, pull at bodies, set pins and move them, move colliders.
import type { Command, Vec3 } from './protocol';
import type { Picked, Stage } from './view/stage';

/** CSS pixels that a pointer may move during a click. */
const clickSlack = { mouse: 4, touch: 10 };
const pinReach = { mouse: 9, touch: 22 };

type Action =
  | { kind: 'none' | 'orbit' | 'pan' | 'pinch' }
  /** Pressed on something: a click pins, a drag pulls. */
  | { kind: 'touch'; picked: Picked }
  | { kind: 'drag'; picked: Picked };

interface Place {
  x: number;
  y: number;
}

const distance = (a: Place, b: Place): number => Math.hypot(a.x - b.x, a.y - b.y);

export class Hands {
  private action: Action = { kind: 'none' };
  private readonly pointers = new Map<number, Place>();
  private pressed: Place = { x: 0, y: 0 };
  private last: Place = { x: 0, y: 0 };
  private hover: Place | null = null;
  private goal: Command | null = null;

  /** done: called when something was pulled, pinned or moved. */
  constructor(private readonly canvas: HTMLCanvasElement, private readonly stage: Stage,
              private readonly send: (command: Command) => void, private readonly done: (what: string) => void) {
    canvas.addEventListener('pointerdown', (event) => this.press(event));
    canvas.addEventListener('pointermove', (event) => this.move(event));
    canvas.addEventListener('pointerup', (event) => this.release(event));
    canvas.addEventListener('pointercancel', (event) => this.release(event));
    canvas.addEventListener('pointerleave', () => this.leave());
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
  }

  /** Forgets what is held, as when another scene is shown. */
  cancel(): void {
    this.action = { kind: 'none' };
    this.goal = null;
    this.stage.highlight(null);
  }

  /** Once a picture: sends where what is held shall go, and lights up what the mouse would grab. */
  flush(): void {
    if (this.goal !== null) this.send(this.goal);
    this.goal = null;
    if (this.hover === null) return;
    const picked = this.stage.pick(this.hover.x, this.hover.y, pinReach.mouse);
    this.stage.highlight(picked);
    this.canvas.style.cursor = picked === null ? 'grab' : 'pointer';
    this.hover = null;
  }

  private placeOf(event: PointerEvent | WheelEvent): Place {
    const box = this.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  private press(event: PointerEvent): void {
    const place = this.placeOf(event);
    this.canvas.setPointerCapture(event.pointerId);
    this.canvas.focus({ preventScroll: true });
    this.pointers.set(event.pointerId, place);
    if (this.pointers.size > 1) return this.beginPinch();
    this.pressed = this.last = place;
    if (event.button === 1 || event.shiftKey) this.action = { kind: 'pan' };
    else if (event.button === 2) this.action = { kind: 'orbit' };
    else this.pressFirst(place, event.pointerType === 'touch' ? pinReach.touch : pinReach.mouse);
  }

  private pressFirst(place: Place, reach: number): void {
    const picked = this.stage.pick(place.x, place.y, reach);
    this.action = picked === null ? { kind: 'orbit' } : { kind: 'touch', picked };
    this.stage.highlight(picked);
    if (picked === null) this.canvas.style.cursor = 'grabbing';
  }

  /** Two fingers hold the picture; what one of them held is let go. */
  private beginPinch(): void {
    if (this.action.kind === 'drag') this.letGo(this.action.picked);
    this.goal = null;
    this.action = { kind: 'pinch' };
    this.stage.highlight(null);
  }

  private move(event: PointerEvent): void {
    const place = this.placeOf(event);
    const known = this.pointers.get(event.pointerId);
    if (known === undefined) {
      if (event.pointerType === 'mouse') this.hover = place;
      return;
    }
    if (this.action.kind === 'pinch') return this.pinch(event.pointerId, place);
    this.pointers.set(event.pointerId, place);
    const slack = event.pointerType === 'touch' ? clickSlack.touch : clickSlack.mouse;
    if (this.action.kind === 'touch' && distance(place, this.pressed) > slack) this.begin(this.action.picked, place);
    else if (this.action.kind === 'drag') this.goal = this.goalOf(this.action.picked, place);
    else if (this.action.kind === 'orbit') this.stage.orbit(place.x - this.last.x, place.y - this.last.y);
    else if (this.action.kind === 'pan') this.stage.pan(place.x - this.last.x, place.y - this.last.y);
    this.last = place;
  }

  private pinch(id: number, place: Place): void {
    const [a, b] = [...this.pointers.values()];
    this.pointers.set(id, place);
    const [c, d] = [...this.pointers.values()];
    if (a === undefined || b === undefined || c === undefined || d === undefined) return;
    this.stage.zoom(distance(a, b) / Math.max(distance(c, d), 1));
    this.stage.pan((c.x + d.x - a.x - b.x) / 2, (c.y + d.y - a.y - b.y) / 2);
  }

  private begin(picked: Picked, place: Place): void {
    this.action = { kind: 'drag', picked };
    this.canvas.style.cursor = 'grabbing';
    const to = this.stage.pointAt(place.x, place.y, picked.position);
    if (picked.kind === 'body') this.send({ type: 'grab', point: picked.point, to });
    else this.goal = this.goalOf(picked, place);
    this.stage.highlight(null);
  }

  private goalOf(picked: Picked, place: Place): Command {
    const to = this.stage.pointAt(place.x, place.y, picked.position);
    if (picked.kind === 'body') return { type: 'pullTo', to };
    if (picked.kind === 'pin') return { type: 'movePin', vertex: picked.vertex, to };
    // The middle of a collider is not where it was taken.
    const grip = picked.grip;
    return { type: 'moveCollider', number: picked.number, to: to.map((x, i) => x + (grip[i] ?? 0)) as Vec3 };
  }

  private release(event: PointerEvent): void {
    const action = this.action;
    this.pointers.delete(event.pointerId);
    if (this.pointers.size > 0) return;
    this.action = { kind: 'none' };
    this.canvas.style.cursor = 'grab';
    if (action.kind === 'touch' && event.type === 'pointerup') this.click(action.picked);
    if (action.kind === 'drag') this.letGo(action.picked);
    this.stage.highlight(null);
  }

  private click(picked: Picked): void {
    if (picked.kind === 'pin') this.send({ type: 'unpin', vertex: picked.vertex });
    else if (picked.kind === 'body') this.send({ type: 'pin', vertex: picked.nearest });
    this.done('click');
  }

  private letGo(picked: Picked): void {
    if (this.goal !== null) this.send(this.goal);
    this.goal = null;
    if (picked.kind === 'body') this.send({ type: 'letGo' });
    else if (picked.kind === 'pin') this.send({ type: 'dropPin', vertex: picked.vertex });
    else this.send({ type: 'dropCollider', number: picked.number });
    this.done('drag');
  }

  private leave(): void {
    this.hover = null;
    if (this.action.kind === 'none') this.stage.highlight(null);
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    if (this.action.kind === 'drag') return;  // what is held keeps its depth
    const notches = event.deltaY / (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 3 : 100);
    this.stage.zoom(Math.pow(0.88, -Math.max(-3, Math.min(3, notches))));
  }
}
