// The page. The console has it as `pliantPage`.
import { App } from './app';

const page = new App();
Object.assign(globalThis, { pliantPage: page });
page.start();
