// The page. The console has it as `pliantPage`.
import { Client } from './client';

// The simulation begins to load before what draws it.
const client = new Client();
try {
  const { App } = await import('./app');
  const page = new App(client);
  Object.assign(globalThis, { pliantPage: page });
  page.start();
} catch (error) {
  const box = document.getElementById('loading-text');
  if (box !== null) box.textContent = error instanceof Error ? error.message : String(error);
  throw error;
}
