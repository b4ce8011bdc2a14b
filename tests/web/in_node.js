// In front of the test programs: Emscripten 3.1.6 would fetch the .wasm file, and node's fetch takes no paths.
delete globalThis.fetch;
