// A scene as a link: its name, or its whole text, after the # of the address.

/** What follows the #: a built-in scene, or a text. */
export type Shared = { kind: 'builtin'; name: string } | { kind: 'text'; name: string; text: string };

/** No address is longer than what chat programs and browsers take [characters]. */
export const longestLink = 16000;
/** No text is longer than that, whatever a link unpacks to [bytes]. */
const longestText = 4_000_000;

class TooLarge extends Error {}

function toBase64Url(bytes: Uint8Array): string {
  let text = '';
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
}

function fromBase64Url(text: string): Uint8Array<ArrayBuffer> {
  const binary = atob(text.replaceAll('-', '+').replaceAll('_', '/'));
  return Uint8Array.from(binary, (character) => character.charCodeAt(0));
}

async function through(bytes: Uint8Array<ArrayBuffer>, transform: GenericTransformStream): Promise<Uint8Array<ArrayBuffer>> {
  const reader = (new Blob([bytes]).stream().pipeThrough(transform) as ReadableStream<Uint8Array>).getReader();
  const parts: Uint8Array[] = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > longestText) throw new TooLarge('the scene in this link is too large');
    parts.push(value);
  }
  const all = new Uint8Array(size);
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

/** Leaves out the spaces of the text's layout. */
function compact(text: string): string {
  return JSON.stringify(JSON.parse(text));
}

/** The part of the address from the # on. */
export async function hashOf(shared: Shared): Promise<string> {
  if (shared.kind === 'builtin') return `#scene=${encodeURIComponent(shared.name)}`;
  const bytes = new TextEncoder().encode(compact(shared.text));
  const packed = toBase64Url(await through(bytes, new CompressionStream('deflate-raw')));
  return `#name=${encodeURIComponent(shared.name)}&text=${packed}`;
}

/** What the part from the # on says; null: nothing. Throws an Error where it is broken. */
export async function readHash(hash: string): Promise<Shared | null> {
  const values = new URLSearchParams(hash.replace(/^#/, ''));
  const scene = values.get('scene');
  if (scene !== null) return { kind: 'builtin', name: scene };
  const packed = values.get('text');
  if (packed === null) return null;
  if (!('DecompressionStream' in globalThis)) throw new Error('this browser is too old for links that hold a scene; a newer one opens it');
  try {
    const text = new TextDecoder('utf-8', { fatal: true })
      .decode(await through(fromBase64Url(packed), new DecompressionStream('deflate-raw')));
    return { kind: 'text', name: values.get('name') ?? 'shared', text };
  } catch (error) {
    if (error instanceof TooLarge) throw error;
    throw new Error('the scene in this link is damaged; ask for the link again, and copy all of it');
  }
}
