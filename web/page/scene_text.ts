// Changes of a scene's text that the simulation has no command for.

/** With a light wind along x, as one that a user can turn. */
export function addWind(text: string): string {
  const scene = JSON.parse(text) as { forces?: unknown[] };
  return JSON.stringify({ ...scene, forces: [...(scene.forces ?? []), { type: 'wind', velocity: [3, 0, 0] }] });
}
