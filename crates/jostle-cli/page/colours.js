// Colours of disks. Diverging from red over white to blue, as in the films; people with red-green blindness tell them apart.

const ENDS = { low: [202, 45, 50], middle: [245, 245, 245], high: [33, 102, 172] };

function mixed(from, to, share) {
  const part = from.map((value, k) => Math.round(value + (to[k] - value) * share));
  return `rgb(${part.join(",")})`;
}

/** Colour of a number in [-1, 1]. */
export function diverging(share) {
  const bounded = Math.max(-1, Math.min(1, Number.isFinite(share) ? share : 0));
  return bounded < 0 ? mixed(ENDS.middle, ENDS.low, -bounded) : mixed(ENDS.middle, ENDS.high, bounded);
}

/** Colour of a number in [0, 1], from white to blue. */
export function sequential(share) {
  return mixed(ENDS.middle, ENDS.high, Math.max(0, Math.min(1, Number.isFinite(share) ? share : 0)));
}

/** A scale that follows the numbers: it grows at once and shrinks slowly, so that colours do not flicker. */
export class Scale {
  constructor(smallest) {
    this.smallest = smallest;
    this.size = smallest;
  }

  /** Includes these numbers and returns the size. */
  include(numbers) {
    const sizes = Array.from(numbers, Math.abs).sort((a, b) => a - b);
    const large = sizes[Math.floor(0.95 * (sizes.length - 1))] ?? 0;
    this.size = Math.max(this.smallest, large, 0.995 * this.size);
    return this.size;
  }
}
