// Where frames come from: a simulation that runs in the page, or a recorded run. Both give the same.

import { Refused } from "jostle/module";
import { shapes } from "jostle/shapes";

/** Numbers of all disks at one instant, and where base and walls are. */
function frame(value, { scene, x, y, angle, spin, speed, radius, base, time, contacts, view }) {
  const found = view ?? shapes(scene, value, x, y, radius);
  const frequency = value("drive.frequency");
  const turns = frequency === undefined ? null : frequency * time + (value("drive.phase") ?? 0) / (2 * Math.PI);
  return { shapes: found, x, y, angle, spin, speed, radius, base, time, contacts, phase: turns };
}

/** More make the page stand still for seconds. */
const MOST_DISKS = 2000;

/** A scene that runs. */
export class Live {
  constructor(module, { scene, disks, given }) {
    if (disks > MOST_DISKS) {
      throw new Refused(`number of disks = ${disks} is too much for this page: it takes at most ${MOST_DISKS}. jostle run takes more.`);
    }
    this.simulation = module.open(scene, disks, given);
    this.scene = scene;
    this.radius = scene === "wedge" ? [this.value("disk.radius")] : this.simulation.array("disk.radius");
    this.end = Infinity;
    this.view = null;
  }

  value(name) {
    return this.simulation.parameter(name);
  }

  get time() {
    return this.simulation.time;
  }

  get warnings() {
    return this.simulation.warnings;
  }

  /** Advances to `time` [s], in pieces, for at most so many milliseconds. */
  advance(time, milliseconds) {
    const until = performance.now() + milliseconds;
    while (this.time < time && performance.now() < until) this.simulation.advance(Math.min(time, this.time + 1e-3));
  }

  frame(withContacts) {
    const { simulation, radius, scene } = this;
    const [x, y, angle, spin, vx, vy] = ["x", "y", "angle", "angular_velocity", "velocity_x", "velocity_y"].map((name) =>
      simulation.array(`disk.${name}`),
    );
    const speed = vx.map((across, disk) => Math.hypot(across, vy[disk]));
    const contacts = withContacts ? simulation.contacts() : null;
    const shown = { scene, x, y, angle, spin, speed, radius, base: simulation.value("base.position"), time: this.time, contacts };
    const made = frame((name) => this.value(name), { ...shown, view: this.view });
    this.view = made.shapes;
    return { ...made, thick: this.thick };
  }

  /** Force [N] of a line as thick as the ruler: three times the weight of a disk of mean size. */
  get thick() {
    const size = this.radius.reduce((sum, radius) => sum + radius * radius, 0) / this.radius.length;
    return 3 * Math.PI * size * (this.value("disk.surface_density") ?? 0) * (this.value("gravity") || 9.8);
  }

  close() {
    this.simulation.close();
  }
}

/** A recorded run that is played back. The module gives radii and walls for its parameters. */
export class Played {
  constructor(module, recording) {
    this.recording = recording;
    this.scene = recording.scene;
    const like = module.open(recording.scene, recording.disks, known(module, recording));
    this.radius = recording.scene === "wedge" ? [like.parameter("disk.radius")] : like.array("disk.radius");
    this.parameters = new Map(like.variables.map(({ name, value }) => [name, value]));
    like.close();
    // On inputs there is no sine, and no amplitude of it.
    if (!("drive.amplitude" in recording.given)) {
      for (const name of ["drive.amplitude", "drive.frequency"]) this.parameters.delete(name);
    }
    this.time = recording.time[0];
    this.warnings = "";
    this.view = null;
  }

  value(name) {
    return this.parameters.get(name);
  }

  get end() {
    return this.recording.end;
  }

  advance(time) {
    this.time = Math.min(time, this.end);
  }

  frame() {
    const { recording, scene, radius } = this;
    const row = recording.row(this.time);
    const [x, y, angle, spin, vx, vy] = ["x", "y", "angle", "angular_velocity", "velocity_x", "velocity_y"].map((name) =>
      recording.array(`disk.${name}`, row),
    );
    const speed = vx.map((across, disk) => Math.hypot(across, vy[disk]));
    const base = recording.columns.get("base.position")?.[row] ?? 0;
    const time = recording.time[row];
    const made = frame((name) => this.value(name), { scene, x, y, angle, spin, speed, radius, base, time, contacts: null, view: this.view });
    this.view = made.shapes;
    return made;
  }

  /** To the first sample. */
  rewind() {
    this.time = this.recording.time[0];
  }

  close() {}
}

/** The parameters of a recording that the module's engine of that scene has; another engine has others. */
function known(module, { scene, disks, given }) {
  const probe = module.open(scene, disks, {});
  const settable = new Set(probe.variables.filter(({ causality }) => causality === "parameter").map(({ name }) => name));
  probe.close();
  return Object.fromEntries(Object.entries(given).filter(([name]) => settable.has(name)));
}
