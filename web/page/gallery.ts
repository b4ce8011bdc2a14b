// The order in which the page lists the built-in scenes, and their small pictures.
import type { SceneEntry, SceneSource } from './protocol';

/** What one sees first in the list. */
const best = [
  'towel', 'silk_on_figure', 'storm', 'walkers', 'dress', 'trampoline_crowd', 'parachute', 'plank_bridge', 'layers',
  'tablecloth', 'crate_on_cloth', 'soft_rings', 'chain_mail', 'reef_knot', 'turning_ball', 'curtain_wind', 'ball',
];

export const firstScene = 'turning_ball';

export function allScenes(builtin: SceneEntry[]): SceneEntry[] {
  const rank = (name: string): number => (best.includes(name) ? best.indexOf(name) : best.length);
  return [...builtin].sort((a, b) => rank(a.name) - rank(b.name) || a.name.localeCompare(b.name));
}

export function sourceOfName(name: string): SceneSource {
  return { kind: 'builtin', name };
}

export function thumbnailOf(name: string): string {
  return `./thumbnails/${name}.webp`;
}
