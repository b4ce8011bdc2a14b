import type { SceneLook } from '../protocol';

const oneOf = 20;  // edges is shorter
const share = 0.22;

/**
 * About the distance at which bodies touch colliders [m]. Between vertices they come nearer, and so far they are drawn
 * in front all the same; what is behind a collider is never that near to its front.
 */
export function setbackOf(look: SceneLook, positions: Float32Array): number {
  const lengths: number[] = [];
  for (const ends of [look.edges, look.ropes]) {
    for (let i = 0; i + 1 < ends.length; i += 2) {
      const a = 3 * ends[i]!, b = 3 * ends[i + 1]!;
      const length = Math.hypot(positions[b]! - positions[a]!, positions[b + 1]! - positions[a + 1]!,
                                positions[b + 2]! - positions[a + 2]!);
      if (Number.isFinite(length)) lengths.push(length);
    }
  }
  lengths.sort((a, b) => a - b);
  return share * (lengths[Math.floor(lengths.length / oneOf)] ?? 0);
}
