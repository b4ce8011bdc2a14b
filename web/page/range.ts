// From places on a slider to values, and back.
import type { Parameter } from './protocol';

/** Places on a slider, 0 to 1. */
export interface Scale {
  valueAt(place: number): number;
  placeOf(value: number): number;
}

/** Further than that a range is shown by its orders of magnitude. */
const widestLinear = 1000;
const magnitudes = 2;

function clamp(value: number, low: number, high: number): number {
  return Math.min(Math.max(value, low), high);
}

/** With as many digits as one would set by hand. */
export function rounded(value: number): number {
  return Number.isFinite(value) ? Number(value.toPrecision(3)) : value;
}

function linear(low: number, high: number): Scale {
  return {
    valueAt: (place) => low + clamp(place, 0, 1) * (high - low),
    placeOf: (value) => (high > low ? clamp((value - low) / (high - low), 0, 1) : 0),
  };
}

/** 0 at the left end where the range has it; then from `low` to `high` by factors. */
function logarithmic(low: number, high: number, hasZero: boolean): Scale {
  const begin = hasZero ? 0.04 : 0;
  const span = Math.log(high / low);
  return {
    valueAt: (place) => {
      if (hasZero && place < begin / 2) return 0;
      return low * Math.exp((clamp(place - begin, 0, 1 - begin) / (1 - begin)) * span);
    },
    placeOf: (value) => {
      if (hasZero && value <= 0) return 0;
      return begin + clamp(Math.log(Math.max(value, low) / low) / span, 0, 1) * (1 - begin);
    },
  };
}

/**
 * Of a number with this range that is `value` at first: all of the range where one can see it all, else two orders of
 * magnitude on each side of the value. Null where a slider says nothing, as of numbers of both signs without end.
 */
export function scaleOf(parameter: Pick<Parameter, 'kind' | 'min' | 'max'>, value: number): Scale | null {
  const { min, max, kind } = parameter;
  if (!(value >= 0) || (kind !== 'real' && kind !== 'integer')) return null;
  const hasEnds = Number.isFinite(min) && Number.isFinite(max);
  if (hasEnds && (max - min <= 10 || (min >= 0 && max - min <= widestLinear && kind === 'integer'))) {
    return linear(min, max);
  }
  if (min < 0) return null;
  const factor = Math.pow(10, magnitudes);
  const middle = value > 0 ? value : 1;
  const low = Math.max(middle / factor, min > 0 ? min : 0, kind === 'integer' ? 1 : 0);
  const high = Math.min(middle * factor, max);
  return high > low ? logarithmic(low, high, min <= 0) : null;
}
