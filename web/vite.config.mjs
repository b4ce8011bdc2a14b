import { fileURLToPath, pathToFileURL } from 'node:url';
import { defineConfig } from 'vite';
import { firstPictureFile, makeFirstPicture } from './page/first_picture.ts';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
// The module that scripts/build_web.sh puts together.
const module = here('../build/web/npm/index.mjs');

/** What the page draws before the module is there, made by the module. */
const firstPicture = {
  name: 'first-picture',
  apply: 'build',
  async generateBundle() {
    const { loadPliant } = await import(/* @vite-ignore */ pathToFileURL(module).href);
    this.emitFile({ type: 'asset', fileName: firstPictureFile, source: makeFirstPicture(await loadPliant()) });
  },
};

export default defineConfig({
  root: here('page'),
  // The page works in any folder of a server.
  base: './',
  plugins: [firstPicture],
  resolve: { alias: { pliant: module } },
  server: { fs: { allow: [here('..')] } },
  worker: { format: 'es' },
  test: {
    root: here('.'),
    // What takes minutes, or measures, is run by name.
    include: [process.env.PLIANT_SLOW ? 'tests/**/*.slow.ts' : 'tests/**/*.test.ts'],
    testTimeout: 60_000,
    hookTimeout: 60_000,
    fileParallelism: false,
  },
  build: {
    outDir: here('dist'),
    emptyOutDir: true,
    target: 'es2022',
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 1000,
  },
});
