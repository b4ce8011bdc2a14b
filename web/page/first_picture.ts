// What the page draws while the simulation loads: the scene that it opens with, at its start, from a file that the build
// makes of it.
import type { Frame, Pliant, SceneLook } from 'pliant';
import { firstScene } from './gallery.ts';
import { pack, unpack } from './packed.ts';

/** Beside the page. */
export const firstPictureFile = 'first_picture.bin';

export interface FirstPicture {
  name: string;
  description: string;
  look: SceneLook;
  frame: Frame;
}

/** Parts of 1 that normals have in the file: with all their digits they would be half of it. */
const normalSteps = 1024;

/** For the build. The camera of the scene must stand where it does for every shape of the page; a test looks. */
export function makeFirstPicture(pliant: Pliant): Uint8Array {
  const scene = pliant.openScene(pliant.builtinScene(firstScene), firstScene, '');
  const first: FirstPicture = { name: firstScene, description: scene.description(), look: scene.look(1.5), frame: scene.frame() };
  scene.delete();
  for (const collider of first.look.colliders) {
    collider.normals = collider.normals.map((x) => Math.round(normalSteps * x) / normalSteps);
  }
  return pack(first);
}

export function readFirstPicture(file: ArrayBuffer): FirstPicture {
  return unpack(file) as FirstPicture;
}

/** Null where there is none: the page can do without. */
export async function fetchFirstPicture(): Promise<FirstPicture | null> {
  try {
    const response = await fetch(`./${firstPictureFile}`);
    return response.ok ? readFirstPicture(await response.arrayBuffer()) : null;
  } catch {
    return null;
  }
}
