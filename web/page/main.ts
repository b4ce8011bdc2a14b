// The page. The console has it as `pliantPage`.
import { App } from './app';

try {
  const page = new App();
  Object.assign(globalThis, { pliantPage: page });
  page.start();
} catch (error) {
  const box = document.getElementById('loading-text');
  if (box !== null) box.textContent = error instanceof Error ? error.message : String(error);
  throw error;
}
