// The worker: simulates, and tells the page what there is to see. Between two steps it listens to the page.
import { loadPliant } from 'pliant';
import { Simulator } from './simulator';
import type { Command, Report } from './protocol';

const send = (report: Report, transfer: Transferable[] = []): void => self.postMessage(report, { transfer });

const waiting: Command[] = [];
let simulator: Simulator | null = null;

self.addEventListener('message', (event: MessageEvent<Command>) => {
  if (simulator === null) waiting.push(event.data);
  else simulator.command(event.data);
});

loadPliant().then(
  (pliant) => {
    simulator = new Simulator(pliant, send);
    send({ type: 'ready', version: pliant.version(), scenes: pliant.builtinScenes() });
    for (const command of waiting) simulator.command(command);
  },
  (error: unknown) => send({ type: 'error', message: String(error), command: 'load' }),
);
