// The page's side of the worker.
import type { Command, Letter, Report } from './protocol';

type Of<T extends Report['type']> = Extract<Report, { type: T }>;
export type Listeners = { [T in Exclude<Report['type'], 'text'>]: (report: Of<T>) => void };

export class Client {
  /** The number of the `open` whose scene is shown. */
  shown = 0;
  private worker = this.begin();
  private listeners: Listeners | null = null;
  /** What came before anyone listened. */
  private readonly early: Report[] = [];
  private readonly texts = new Map<number, { resolve: (text: string) => void; reject: (error: Error) => void }>();
  private lastText = 0;

  /** Tells what has come, and what comes. */
  listen(listeners: Listeners): void {
    this.listeners = listeners;
    for (const report of this.early.splice(0)) this.take(report);
  }

  send(command: Command): void {
    this.worker.postMessage({ command, scene: this.shown } satisfies Letter);
  }

  /** Gives up whatever the worker is doing, and begins with a new one, in which nothing is open. */
  renew(): void {
    this.worker.terminate();
    for (const { reject } of this.texts.values()) reject(new Error('the scene was given up'));
    this.texts.clear();
    this.shown = 0;
    this.worker = this.begin();
  }

  /** The scene as it is now, as the text of a scene file. */
  text(): Promise<string> {
    const id = ++this.lastText;
    this.send({ type: 'text', id });
    return new Promise((resolve, reject) => this.texts.set(id, { resolve, reject }));
  }

  private begin(): Worker {
    const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' });
    worker.addEventListener('message', (event: MessageEvent<Report>) => this.take(event.data));
    worker.addEventListener('error', (event) => {
      this.take({ type: 'error', message: event.message || 'the simulation could not be loaded', command: 'load' });
    });
    return worker;
  }

  private take(report: Report): void {
    if (this.listeners === null) {
      this.early.push(report);
      return;
    }
    if (report.type === 'text') {
      this.texts.get(report.id)?.resolve(report.text);
      this.texts.delete(report.id);
      return;
    }
    if (report.type === 'error' && report.command === 'text') {
      const id = report.id ?? -1;
      this.texts.get(id)?.reject(new Error(report.message));
      this.texts.delete(id);
      return;
    }
    (this.listeners[report.type] as (report: Report) => void)(report);
  }
}
