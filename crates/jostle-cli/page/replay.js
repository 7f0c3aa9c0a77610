// Recorded runs: `jostle run`'s two CSV files, or the reference trajectory inside of an FMU.

/** Rows of a CSV file without quotes, which ours are. */
function csv(text) {
  return text.trim().split(/\r?\n/).map((line) => line.split(","));
}

/** Files of a zip archive that `wanted` accepts by name, as texts. */
export async function unzipped(buffer, wanted) {
  const view = new DataView(buffer);
  let end = buffer.byteLength - 22;
  while (end >= 0 && view.getUint32(end, true) !== 0x06054b50) end--;
  if (end < 0) throw new Error("The file is no zip archive, which an FMU is.");
  const files = {};
  let entry = view.getUint32(end + 16, true);
  for (let left = view.getUint16(end + 10, true); left > 0; left--) {
    const [method, size] = [view.getUint16(entry + 10, true), view.getUint32(entry + 20, true)];
    const [name, extra, comment] = [28, 30, 32].map((offset) => view.getUint16(entry + offset, true));
    const text = new TextDecoder().decode(new Uint8Array(buffer, entry + 46, name));
    if (wanted(text)) {
      const local = view.getUint32(entry + 42, true);
      const start = local + 30 + view.getUint16(local + 26, true) + view.getUint16(local + 28, true);
      const packed = new Blob([new Uint8Array(buffer, start, size)]);
      const stream = method === 8 ? packed.stream().pipeThrough(new DecompressionStream("deflate-raw")) : packed.stream();
      files[text] = await new Response(stream).text();
    }
    entry += 46 + name + extra + comment;
  }
  return files;
}

/** What made a run, from the CSV file of its parameters: { scene, disks, given }. */
function fromParameters(text) {
  const rows = Object.fromEntries(csv(text).slice(1).map(([name, value]) => [name, value]));
  const { scene, disks, engine, drive, version, seconds, sample, ...given } = rows;
  if (!scene || !disks) throw new Error("The file of parameters names no scene and no number of disks.");
  return { scene, disks: +disks, given };
}

/** The same from the model description of an FMU. */
function fromDescription(text) {
  const root = new DOMParser().parseFromString(text, "text/xml").documentElement;
  const token = root.getAttribute("instantiationToken") ?? root.getAttribute("guid") ?? "";
  const [, scene, , , structure] = token.split(":");
  const disks = /disks=(\d+)/.exec(structure ?? "");
  if (!disks) throw new Error("The FMU is none of jostle: its token names no scene and no number of disks.");
  const given = {};
  for (const variable of root.querySelectorAll("[name][causality='parameter']")) {
    const start = variable.getAttribute("start") ?? variable.firstElementChild?.getAttribute("start");
    if (start !== null && start !== undefined) given[variable.getAttribute("name")] = start;
  }
  return { scene, disks: +disks[1], given };
}

/** A recorded run: { scene, disks, given, time, columns }, columns by name. */
export class Recording {
  static async of(files) {
    const named = (ending) => files.find(({ name }) => name.toLowerCase().endsWith(ending));
    const fmu = named(".fmu");
    if (fmu) {
      const inside = await unzipped(await fmu.arrayBuffer(), (name) => /modelDescription\.xml$|reference\.csv$/.test(name));
      const [description, reference] = [/modelDescription/, /reference/].map((kind) => {
        const found = Object.keys(inside).find((name) => kind.test(name));
        if (!found) throw new Error(`${fmu.name} holds no ${kind.source === "reference" ? "reference trajectory" : "model description"}.`);
        return inside[found];
      });
      return new Recording(fromDescription(description), reference, fmu.name);
    }
    const parameters = named(".parameters.csv");
    const samples = files.find((file) => file !== parameters && file.name.toLowerCase().endsWith(".csv"));
    if (!parameters || !samples) {
      throw new Error("Choose an FMU, or two files at once: a run such as run.csv and its run.parameters.csv.");
    }
    return new Recording(fromParameters(await parameters.text()), await samples.text(), samples.name);
  }

  constructor(made, text, name) {
    Object.assign(this, made, { name });
    const [header, ...rows] = csv(text);
    const missing = ["time", "disk.x[1]", "disk.y[1]", "disk.angle[1]"].filter((column) => !header.includes(column));
    if (missing.length) throw new Error(`${name} has no column ${missing.join(", ")}, which a picture of the disks needs.`);
    this.columns = new Map(header.map((column, k) => [column, Float64Array.from(rows, (row) => +row[k])]));
    this.time = this.columns.get("time");
    const last = `disk.x[${this.disks}]`;
    const count = header.filter((column) => column.startsWith("disk.x[")).length;
    if (count !== this.disks || !header.includes(last)) {
      throw new Error(`${name} has ${count} disks, its parameters have ${this.disks}: they are not of one run.`);
    }
    if (!this.time.length) throw new Error(`${name} has no rows.`);
  }

  get end() {
    return this.time[this.time.length - 1];
  }

  /** The last row that is not after `time` [s]. */
  row(time) {
    let [low, high] = [0, this.time.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.time[middle] <= time) low = middle + 1;
      else high = middle;
    }
    return Math.max(0, low - 1);
  }

  array(name, row) {
    const one = (disk) => this.columns.get(`${name}[${disk + 1}]`)?.[row] ?? NaN;
    return Float64Array.from({ length: this.disks }, (_, disk) => one(disk));
  }
}
