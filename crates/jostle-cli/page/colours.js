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

/** A scale that follows the numbers in steps of 1, 2, 5, 10, so that a colour means the same for a while. */
export class Scale {
  constructor(smallest) {
    this.smallest = smallest;
    this.size = smallest;
    this.low = 0;
  }

  /** Includes these numbers and returns the size. It grows at once, and shrinks when a second of frames asked for less. */
  include(numbers) {
    const sizes = Array.from(numbers, Math.abs).sort((a, b) => a - b);
    const large = Math.max(this.smallest, sizes[Math.floor(0.95 * (sizes.length - 1))] ?? 0);
    this.low = large < 0.3 * this.size ? this.low + 1 : 0;
    if (large > this.size || this.low > 60) this.size = rounded(large);
    return this.size;
  }
}

/** The next of 1, 2, 5 times a power of ten. */
function rounded(size) {
  const power = 10 ** Math.floor(Math.log10(size));
  return power * ([1, 2, 5].find((digit) => digit * power >= size) ?? 10);
}
