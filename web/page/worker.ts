// The worker: simulates, and tells the page what there is to see. Between two steps it listens to the page.
import { loadPliant } from 'pliant';
import { Simulator } from './simulator';
import type { Letter, Report } from './protocol';

const send = (report: Report, transfer: Transferable[] = []): void => self.postMessage(report, { transfer });

/** [ms] */
const listDelay = 1000;

const waiting: Letter[] = [];
let simulator: Simulator | null = null;

self.addEventListener('message', (event: MessageEvent<Letter>) => {
  if (simulator === null) waiting.push(event.data);
  else simulator.command(event.data.command, event.data.scene);
});

loadPliant().then(
  (pliant) => {
    simulator = new Simulator(pliant, send);
    for (const { command, scene } of waiting) simulator.command(command, scene);
    // The list of scenes is not needed for the first picture, and takes as long as that.
    setTimeout(() => send({ type: 'ready', scenes: pliant.builtinScenes(), colors: pliant.colorMaps() }), listDelay);
  },
  (error: unknown) => send({ type: 'error', message: `this browser cannot run the simulation: ${String(error)}`, command: 'load' }),
);
