// What can be changed of each scene by a slider. Ranges here are those in which something happens; the module checks the
// ranges in which a value makes sense at all. Every other parameter is in the list of all parameters.

const degrees = { shown: "degrees", factor: 180 / Math.PI };
const millimetres = { shown: "mm", factor: 1e3 };

/** Sliders by scene: name of the parameter (`gamma` and `disks` are the page's own), label, range and step in the shown unit. */
export const SLIDERS = {
  packing: [
    { name: "gamma", label: "Gamma, largest acceleration of the base over gravity", min: 0, max: 10, step: 0.05, usual: 2 },
    { name: "drive.frequency", label: "frequency of the base", shown: "Hz", min: 20, max: 200, step: 1 },
    { name: "contact.friction", label: "friction coefficient", min: 0, max: 1, step: 0.01 },
    { name: "disks", label: "number of disks", min: 3, max: 300, step: 1 },
    { name: "box.width", label: "width of the box", ...millimetres, min: 100, max: 1000, step: 10 },
  ],
  ratchet: [
    { name: "gamma", label: "Gamma, largest acceleration of the base over gravity", min: 0, max: 10, step: 0.05 },
    { name: "drive.frequency", label: "frequency of the base", shown: "Hz", min: 10, max: 60, step: 0.5 },
    { name: "tooth.height", label: "height of a tooth", ...millimetres, min: 0, max: 12, step: 0.1 },
    { name: "tooth.asymmetry", label: "asymmetry: share of the left side", min: 0, max: 1, step: 0.01 },
    { name: "collision.friction", label: "friction coefficient", min: 0, max: 1, step: 0.01 },
    { name: "collision.restitution", label: "normal restitution", min: 0.3, max: 1, step: 0.01 },
    { name: "disks", label: "number of disks", min: 1, max: 200, step: 1 },
  ],
  wedge: [
    { name: "gamma", label: "Gamma, largest acceleration of the wedge over gravity", min: 0, max: 20, step: 0.1 },
    { name: "drive.frequency", label: "frequency of the wedge", shown: "Hz", min: 10, max: 200, step: 1 },
    { name: "wedge.aperture", label: "angle between the walls", ...degrees, min: 61, max: 175, step: 1 },
    { name: "wedge.tilt", label: "tilt, counter-clockwise", ...degrees, min: -45, max: 45, step: 0.5 },
    { name: "contact.friction", label: "friction coefficient", min: 0, max: 1, step: 0.01 },
    { name: "collision.restitution", label: "normal restitution", min: 0.3, max: 1, step: 0.01 },
  ],
};

/** Slow motion at the start, how many times slower than life. */
export const SLOWNESS = { packing: 20, ratchet: 10, wedge: 10 };

/** Largest acceleration of the base over gravity. */
export function gammaOf(amplitude, frequency, gravity) {
  return (amplitude * (2 * Math.PI * frequency) ** 2) / gravity;
}

/** Amplitude [m] of a base that has this Gamma. */
export function amplitudeOf(gamma, frequency, gravity) {
  return (gamma * gravity) / (2 * Math.PI * frequency) ** 2;
}
