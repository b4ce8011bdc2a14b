// The module with the file of its code found by itself, in browsers, workers and node.
import createPliant from './pliant.mjs';

async function readBeside() {
  const { readFile } = await import(/* webpackIgnore: true */ /* @vite-ignore */ 'node:fs/promises');
  return readFile(new URL('./pliant.wasm', import.meta.url));
}

export async function loadPliant(options = {}) {
  // Emscripten 3.1.6 would fetch it, and node's fetch takes no files.
  const isNode = typeof process === 'object' && process.versions?.node !== undefined;
  const wasmBinary = options.wasmBinary ?? (isNode ? await readBeside() : undefined);
  return createPliant(wasmBinary === undefined ? {} : { wasmBinary });
}
