// The page. The console has it as `pliantPage`.
import { Client } from './client';
import { fetchFirstPicture } from './first_picture';

// The simulation begins to load before what draws it.
const client = new Client();
const first = location.hash.length > 1 ? Promise.resolve(null) : fetchFirstPicture();
try {
  const { App } = await import('./app');
  const page = new App(client, first);
  Object.assign(globalThis, { pliantPage: page });
  page.start();
} catch (error) {
  const box = document.getElementById('loading-text');
  if (box !== null) box.textContent = error instanceof Error ? error.message : String(error);
  throw error;
}
