import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));

export default defineConfig({
  root: here('page'),
  // The page works in any folder of a server.
  base: './',
  // The module that scripts/build_web.sh puts together.
  resolve: { alias: { pliant: here('../build/web/npm/index.mjs') } },
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
