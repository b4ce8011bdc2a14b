// Scenes and meshes from files of one's own, dropped or chosen.
import type { NamedFile, SceneSource, UpAxis } from './protocol';

/** What the simulation reads as a mesh. */
export const meshEndings = ['obj', 'ply', 'stl', 'off', 'msh', 'mesh', 'vtk', 'node', 'ele'];
export const sceneEnding = 'json';
/** More than that fills the memory of a page [bytes]. */
export const largestFiles = 200e6;

function endingOf(name: string): string {
  const parts = name.split('.');
  return parts.length < 2 ? '' : (parts[parts.length - 1] ?? '').toLowerCase();
}

/** A scene among the files is opened with the others beside it; else the first mesh. Throws an Error without either. */
export function sourceOf(files: NamedFile[], up: UpAxis): SceneSource {
  const scene = files.find((file) => endingOf(file.name) === sceneEnding);
  if (scene !== undefined) {
    return { kind: 'text', text: new TextDecoder().decode(scene.bytes), name: scene.name, files };
  }
  const mesh = files.find((file) => meshEndings.includes(endingOf(file.name)));
  if (mesh !== undefined) return { kind: 'mesh', name: mesh.name, files, up };
  const names = files.map((file) => file.name).join(', ');
  throw new Error(`${names}: neither a scene (.json) nor a mesh (${meshEndings.map((each) => `.${each}`).join(', ')})`);
}

export async function readFiles(list: Iterable<File>): Promise<NamedFile[]> {
  const files = [...list];
  const size = files.reduce((sum, file) => sum + file.size, 0);
  if (size > largestFiles) throw new Error(`${Math.round(size / 1e6)} MB are too much for a page; use the program instead`);
  return Promise.all(files.map(async (file) => ({ name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) })));
}

/** Lets the browser save a text as a file. */
export function download(name: string, text: string): void {
  const address = URL.createObjectURL(new Blob([text], { type: 'application/json' }));
  const link = document.createElement('a');
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
