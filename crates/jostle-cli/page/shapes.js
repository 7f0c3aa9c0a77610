// Base and walls of each scene as lines in metres, and the part of the plane that is shown.

/** Corners (x, y) of one tooth, from its left foot to its right foot, with a rounded tip. */
export function tooth(width, height, asymmetry, radius) {
  const apex = [asymmetry * width, height];
  if (height === 0) return [[0, 0], [width, 0]];
  const down = [[0, 0], [width, 0]].map(([x, y]) => {
    const [dx, dy] = [x - apex[0], y - apex[1]];
    const length = Math.hypot(dx, dy);
    return [dx / length, dy / length];
  });
  const half = Math.acos(Math.max(-1, Math.min(1, down[0][0] * down[1][0] + down[0][1] * down[1][1]))) / 2;
  const cut = radius / Math.tan(half);
  const middle = [down[0][0] + down[1][0], down[0][1] + down[1][1]];
  const length = Math.hypot(...middle);
  const centre = [0, 1].map((k) => apex[k] + ((radius / Math.sin(half)) * middle[k]) / length);
  const ends = down.map((side) => [apex[0] + cut * side[0], apex[1] + cut * side[1]]);
  const [from, to] = ends.map(([x, y]) => Math.atan2(y - centre[1], x - centre[0]));
  const turn = from - to; // clockwise over the top
  const arc = Array.from({ length: 9 }, (_, k) => {
    const angle = from - (turn * k) / 8;
    return [centre[0] + radius * Math.cos(angle), centre[1] + radius * Math.sin(angle)];
  });
  return [[0, 0], ...arc, [width, 0]];
}

/** { moving, still: lines; view: { left, right, bottom, top }; period or null } of a scene. `value` gives a parameter by name. */
export function shapes(scene, value, x, y, radius) {
  const highest = Math.max(...y.map((height, disk) => height + radius[disk]));
  const sweep = value("drive.amplitude") ?? 0;
  if (scene === "packing") {
    const half = 0.5 * value("box.width");
    const top = 1.3 * highest;
    const sides = [[[-half, 0], [-half, 10 * top]], [[half, 0], [half, 10 * top]]];
    const floor = [[-half, 0], [half, 0]];
    const follow = value("wall.motion") === 2;
    const view = { left: -1.04 * half, right: 1.04 * half, bottom: -0.06 * half - sweep, top };
    return { moving: follow ? [floor, ...sides] : [floor], still: follow ? [] : sides, view, period: null };
  }
  if (scene === "ratchet") {
    const [width, count] = [value("tooth.width"), value("tooth.count")];
    const one = tooth(width, value("tooth.height"), value("tooth.asymmetry"), value("tooth.tip_radius"));
    const row = Array.from({ length: count + 2 }, (_, n) => one.map(([x, y]) => [x + (n - 1) * width, y])).flat();
    const period = width * count;
    const view = { left: 0, right: period, bottom: -0.25 * width - sweep, top: Math.max(1.3 * highest, 0.45 * period) };
    return { moving: [row], still: [], view, period };
  }
  // The walls of the wedge have the angles -(aperture / 2 -+ tilt) to the bisector, which is tilted counter-clockwise.
  const [aperture, tilt] = [value("wedge.aperture"), value("wedge.tilt")];
  const size = 6 * radius[0];
  const wall = (angle) => [[0, 0], [-10 * size * Math.sin(angle), 10 * size * Math.cos(angle)]];
  const view = { left: -0.5 * size, right: 0.5 * size, bottom: -0.1 * size - sweep, top: 0.9 * size };
  return { moving: [wall(tilt + aperture / 2), wall(tilt - aperture / 2)], still: [], view, period: null };
}
