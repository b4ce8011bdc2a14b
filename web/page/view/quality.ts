// How much light a picture follows: all of it, unless pictures then take too long.

export interface QualityLevel {
  name: 'full' | 'medium' | 'low' | 'lowest';
  /** Pixels of the drawing buffer for a CSS pixel, at most. */
  pixelRatio: number;
  /** Texels of the map of shadows of bodies on bodies; 0: none, only those on floors. */
  shadowMap: number;
  /** Places of it that are looked up for a pixel. */
  taps: number;
  /** Texels of the mask of the shadow on a floor. */
  mask: number;
}

export const levels: readonly QualityLevel[] = [
  { name: 'full', pixelRatio: 2, shadowMap: 2048, taps: 16, mask: 192 },
  { name: 'medium', pixelRatio: 1, shadowMap: 1024, taps: 4, mask: 192 },
  { name: 'low', pixelRatio: 1, shadowMap: 0, taps: 0, mask: 128 },
  { name: 'lowest', pixelRatio: 0.5, shadowMap: 0, taps: 0, mask: 128 },
];

/** Intervals in the mean that decide, and the longest mean that is well [ms]. */
const decidedAfter = 40;
const longest = 1000 / 34;
/** A pause, not a picture [ms]. */
const pause = 400;
/** After a change drivers compile and tabs come back: these pictures do not count. */
const leftOut = 8;

/** Whether the processor draws in place of a graphics card. */
export function isSoftware(renderer: string): boolean {
  return /swiftshader|llvmpipe|software|basic render/i.test(renderer);
}

export class Quality {
  private number: number;
  private count = -leftOut;
  private sum = 0;

  constructor(renderer: string) {
    this.number = isSoftware(renderer) ? 2 : 0;
  }

  get level(): QualityLevel {
    return levels[this.number]!;
  }

  /** A picture has taken that long. Says whether the level is another one now. */
  note(milliseconds: number): boolean {
    if (!(milliseconds > 0) || milliseconds > pause) return false;
    this.count += 1;
    if (this.count <= 0) return false;
    this.sum += milliseconds;
    if (this.count < decidedAfter) return false;
    const isSlow = this.sum > decidedAfter * longest && this.number + 1 < levels.length;
    if (isSlow) this.number += 1;
    this.count = isSlow ? -leftOut : 0;
    this.sum = 0;
    return isSlow;
  }

  /** Takes this one from now on; it may still go down. */
  choose(name: string): void {
    const number = levels.findIndex((each) => each.name === name);
    if (number >= 0) this.number = number;
    this.forget();
  }

  /** Of another scene nothing is known. */
  forget(): void {
    this.count = -leftOut;
    this.sum = 0;
  }
}
