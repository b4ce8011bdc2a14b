// The module with the file of its code found by itself, in browsers, workers and node.
import createPliant from './pliant.mjs';

async function readBeside() {
  const { readFile } = await import(/* webpackIgnore: true */ /* @vite-ignore */ 'node:fs/promises');
  return readFile(new URL('./pliant.wasm', import.meta.url));
}

/** A function that makes a vector of 16 zeros and takes it apart. */
const vectors = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15,
                                253, 98, 11]);

export async function loadPliant(options = {}) {
  if (!WebAssembly.validate(vectors)) {
    throw new Error('there are no vectors of WebAssembly (SIMD), which Pliant is compiled for; '
                    + 'take Chrome 95, Firefox 100, Safari 16.4 or newer');
  }
  // Emscripten 3.1.6 would fetch it, and node's fetch takes no files.
  const isNode = typeof process === 'object' && process.versions?.node !== undefined;
  const wasmBinary = options.wasmBinary ?? (isNode ? await readBeside() : undefined);
  return createPliant(wasmBinary === undefined ? {} : { wasmBinary });
}
