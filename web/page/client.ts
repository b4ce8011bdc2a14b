// The page's side of the worker.
import type { Command, Report } from './protocol';

type Of<T extends Report['type']> = Extract<Report, { type: T }>;
export type Listeners = { [T in Exclude<Report['type'], 'text'>]: (report: Of<T>) => void };

export class Client {
  private readonly worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' });
  private readonly texts = new Map<number, { resolve: (text: string) => void; reject: (error: Error) => void }>();
  private lastText = 0;

  constructor(private readonly listeners: Listeners) {
    this.worker.addEventListener('message', (event: MessageEvent<Report>) => this.take(event.data));
    this.worker.addEventListener('error', (event) => {
      listeners.error({ type: 'error', message: event.message || 'the simulation could not be loaded', command: 'load' });
    });
  }

  send(command: Command): void {
    this.worker.postMessage(command);
  }

  /** The scene as it is now, as the text of a scene file. */
  text(): Promise<string> {
    const id = ++this.lastText;
    this.send({ type: 'text', id });
    return new Promise((resolve, reject) => this.texts.set(id, { resolve, reject }));
  }

  private take(report: Report): void {
    if (report.type === 'text') {
      this.texts.get(report.id)?.resolve(report.text);
      this.texts.delete(report.id);
      return;
    }
    if (report.type === 'error' && report.command === 'text') {
      for (const { reject } of this.texts.values()) reject(new Error(report.message));
      this.texts.clear();
      return;
    }
    (this.listeners[report.type] as (report: Report) => void)(report);
  }
}
