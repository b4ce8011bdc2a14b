import { describe, expect, it } from 'vitest';
import { sourceOf } from '../page/files';
import { hashOf, readHash } from '../page/share';

const file = (name: string, text = ''): { name: string; bytes: Uint8Array } =>
  ({ name, bytes: new TextEncoder().encode(text) });

describe('files that are opened', () => {
  it('are a scene with what it needs, or a mesh', () => {
    expect(sourceOf([file('a.obj'), file('b.JSON', '{}')], 'z')).toMatchObject({ kind: 'text', name: 'b.JSON', text: '{}' });
    expect(sourceOf([file('notes.txt'), file('Cloth.PLY')], 'y')).toMatchObject({ kind: 'mesh', name: 'Cloth.PLY', up: 'y' });
  });

  it('are refused by name where they are neither', () => {
    expect(() => sourceOf([file('photo.png'), file('README')], 'z')).toThrow(/photo\.png, README: neither a scene/);
  });
});

describe('a link', () => {
  it('has the name of a built-in scene', async () => {
    expect(await hashOf({ kind: 'builtin', name: 'towel' })).toBe('#scene=towel');
    expect(await readHash('#scene=towel')).toEqual({ kind: 'builtin', name: 'towel' });
  });

  it('has a whole scene, whatever is in it', async () => {
    const text = JSON.stringify({ pliant: 1, description: 'Seide über „Kugel“ & <b> + / = 絹', numbers: [1e-9, -0.1] });
    const hash = await hashOf({ kind: 'text', name: 'a&b=c', text });
    expect(hash).toMatch(/^#[A-Za-z0-9=&%._~-]+$/);
    expect(await readHash(hash)).toEqual({ kind: 'text', name: 'a&b=c', text });
  });

  it('is short', async () => {
    const body = { name: 'cloth', mesh: { shape: 'grid', columns: 30, rows: 30 }, material: 'cotton' };
    const text = JSON.stringify({ pliant: 1, bodies: Array.from({ length: 20 }, (_, i) => ({ ...body, name: `cloth ${i}` })) }, null, 2);
    expect((await hashOf({ kind: 'text', name: 'cloths', text })).length).toBeLessThan(text.length / 5);
  });

  it('that is damaged is told so', async () => {
    const hash = await hashOf({ kind: 'text', name: 'x', text: '{"pliant": 1, "bodies": [], "description": "long enough"}' });
    await expect(readHash(hash.slice(0, -12))).rejects.toThrow(/damaged/);
    await expect(readHash('#text=%%%')).rejects.toThrow(/damaged/);
    await expect(readHash('#text=!!!')).rejects.toThrow(/damaged/);
  });

  it('that unpacks to more than a scene can be is refused', async () => {
    const bytes = await new Response(new Blob([' '.repeat(8_000_000)]).stream()
      .pipeThrough(new CompressionStream('deflate-raw'))).arrayBuffer();
    const packed = Buffer.from(bytes).toString('base64url');
    await expect(readHash(`#text=${packed}`)).rejects.toThrow(/too large/);
  });

  it('that says nothing opens nothing', async () => {
    expect(await readHash('')).toBeNull();
    expect(await readHash('#')).toBeNull();
  });
});
