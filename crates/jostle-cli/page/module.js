// The WebAssembly module: texts and numbers across its border, simulations as objects.

const encoder = new TextEncoder();
const decoder = new TextDecoder();

/** What the module refuses, with its full text. */
export class Refused extends Error {}

/** The scenes of the module. `bytes` is the module itself. */
export class Module {
  static async load(bytes) {
    const { instance } = await WebAssembly.instantiate(bytes, {});
    instance.exports.jostle_prepare();
    return new Module(instance.exports);
  }

  constructor(exports) {
    this.exports = exports;
  }

  /** Calls a function of the module; a panic in it becomes an error with its text. */
  call(name, ...given) {
    const { exports } = this;
    try {
      return exports[`jostle_${name}`](...given);
    } catch (trap) {
      const text = this.bytes(exports.jostle_panic_text(), exports.jostle_panic_length());
      throw new Error(`A defect of jostle: ${text || trap}. Load the page anew.`);
    }
  }

  /** As `call`, for functions that return -1 where they refuse. */
  ask(name, ...given) {
    const value = this.call(name, ...given);
    if (value < 0) throw new Refused(this.text());
    return value;
  }

  bytes(address, length) {
    return decoder.decode(new Uint8Array(this.exports.memory.buffer, address, length));
  }

  text() {
    return this.bytes(this.call("text"), this.call("text_length"));
  }

  table() {
    const lines = this.text().split("\n").slice(0, -1);
    return lines.map((line) => line.split("\t"));
  }

  /** `count` numbers that the last call left, copied. */
  numbers(count) {
    return new Float64Array(this.exports.memory.buffer, this.call("numbers"), count).slice();
  }

  /** What there is: { scene, engine, drive, fewest, most, usual, description }. */
  scenes() {
    this.call("scenes");
    return this.table().map(([scene, engine, drive, fewest, most, usual, description]) => {
      return { scene, engine, drive, fewest: +fewest, most: +most, usual: +usual, description };
    });
  }

  /** Starts a scene at time 0; `given` maps names to values. */
  open(scene, disks, given) {
    const lines = [`scene ${scene}`, `disks ${disks}`, ...Object.entries(given).map(([name, value]) => `${name} ${value}`)];
    const text = encoder.encode(lines.join("\n"));
    const address = this.call("room", text.length);
    new Uint8Array(this.exports.memory.buffer, address, text.length).set(text);
    return new Simulation(this, this.ask("open"), scene, disks);
  }
}

/** A simulation of the module. */
export class Simulation {
  constructor(module, number, scene, disks) {
    Object.assign(this, { module, number, scene, disks, time: 0 });
    module.ask("variables", number);
    this.variables = module.table().map(([name, causality, kind, unit, min, max, start, value, options, description], position) => {
      const list = options ? options.split(",") : [];
      const numbers = { min: +min.replace("inf", "Infinity"), max: +max.replace("inf", "Infinity"), start: +start, value: +value };
      return { position, name, causality, kind, unit, options: list, description, ...numbers };
    });
    this.byName = new Map(this.variables.map((variable) => [variable.name, variable]));
    module.ask("warnings", number);
    this.warnings = module.text();
  }

  has(name) {
    return this.byName.has(name) || this.byName.has(`${name}[1]`);
  }

  /** A parameter as it was set. */
  parameter(name) {
    return this.byName.get(name)?.value;
  }

  advance(time) {
    if (time <= this.time) return;
    this.module.ask("advance", this.number, time);
    this.time = time;
  }

  /** Present value of a variable. */
  value(name) {
    return this.array(name, 1)[0];
  }

  /** Present values of an array such as disk.x, or of `count` variables from `name` on. */
  array(name, count = this.disks) {
    const found = this.byName.get(`${name}[1]`) ?? this.byName.get(name);
    this.module.ask("read", this.number, found.position, count);
    return this.module.numbers(count);
  }

  /** Present values of all variables from position `first` to before `end`. */
  slice(first, end) {
    this.module.ask("read", this.number, first, end - first);
    return this.module.numbers(end - first);
  }

  /** Closed contacts as { first, second, x, y, force }, or null for engines without lasting ones. */
  contacts() {
    if (!this.byName.has("contacts")) return null;
    const count = this.module.ask("contacts", this.number);
    const numbers = this.module.numbers(9 * count);
    return Array.from({ length: count }, (_, row) => {
      const [first, second, , x, y, , , force] = numbers.subarray(9 * row, 9 * row + 9);
      return { first: first - 1, second: second - 1, x, y, force };
    });
  }

  close() {
    this.module.call("close", this.number);
  }
}
