// The scenes that the page offers beside those that are built into the module: those of docs/gallery.
import type { SceneEntry, SceneSource } from './protocol';

const texts = import.meta.glob<string>('../../docs/gallery/*.json', { query: '?raw', import: 'default', eager: true });

const gallery = new Map(Object.entries(texts).map(([path, text]) => [path.replace(/^.*\/|\.json$/g, ''), text]));

/** What one sees first in the list. */
const best = [
  'towel', 'silk_on_figure', 'storm', 'dress', 'trampoline_crowd', 'parachute', 'plank_bridge', 'layers', 'tablecloth',
  'crate_on_cloth', 'soft_rings', 'chain_mail', 'reef_knot', 'turning_ball', 'curtain_wind', 'ball',
];

export const firstScene = 'turning_ball';

function descriptionOf(text: string): string {
  const { description } = JSON.parse(text) as { description?: string };
  return description ?? '';
}

export function allScenes(builtin: SceneEntry[]): SceneEntry[] {
  const all = [...builtin, ...[...gallery].map(([name, text]) => ({ name, description: descriptionOf(text) }))];
  const rank = (name: string): number => (best.includes(name) ? best.indexOf(name) : best.length);
  return all.sort((a, b) => rank(a.name) - rank(b.name) || a.name.localeCompare(b.name));
}

export function sourceOfName(name: string): SceneSource {
  const text = gallery.get(name);
  return text === undefined ? { kind: 'builtin', name } : { kind: 'text', text, name, files: [] };
}

/** Whether that is the text of one of them, unchanged. */
export function isOfGallery(source: SceneSource): boolean {
  return source.kind === 'builtin' || (source.kind === 'text' && gallery.get(source.name) === source.text);
}

export function thumbnailOf(name: string): string {
  return `./thumbnails/${name}.webp`;
}
