// A run as files: the samples and the parameters, as `jostle run` writes them.

/** The text of a number that reads back to the same bits. */
function text(value) {
  return Object.is(value, -0) ? "-0" : `${value}`;
}

/** Values that are kept at most: some 20 MB of text. */
const MOST = 2e6;

/** Runs a scene from its start to `end` [s] and returns { samples, parameters }, two CSV texts. `progress` gets a share in
 * [0, 1] and is awaited, so that the page stays alive; it returns false to stop, and the result is then null. */
export async function recorded(module, { scene, disks, given }, end, sample, progress) {
  const simulation = module.open(scene, disks, given);
  try {
    const { variables } = simulation;
    const outputs = variables.filter(({ causality }) => causality === "output");
    const [first, last] = [outputs[0].position, outputs[outputs.length - 1].position + 1];
    const count = Math.max(1, Math.ceil(end / sample - 1e-9));
    if (!((count + 1) * (last - first + 1) <= MOST)) {
      const fits = Math.floor(MOST / (last - first + 1));
      throw new Error(`${end} s with a row every ${sample} s are ${count + 1} rows; the page saves at most ${fits}. Save fewer, or use jostle run.`);
    }
    const rows = [["time", ...outputs.map(({ name }) => name)].join(",")];
    for (let row = 0; row <= count; row++) {
      const time = Math.min(row * sample, end);
      simulation.advance(time);
      rows.push([text(time), ...Array.from(simulation.slice(first, last), text)].join(","));
      if (row % 20 === 0 && (await progress(row / count)) === false) return null;
    }
    return { samples: `${rows.join("\n")}\n`, parameters: parameters(simulation, module, end, sample) };
  } finally {
    simulation.close();
  }
}

function parameters(simulation, module, end, sample) {
  const { engine, drive } = module.scenes().find(({ scene }) => scene === simulation.scene);
  const rows = [
    ["name", "value", "unit"],
    ["scene", simulation.scene, ""],
    ["engine", engine, ""],
    ["drive", drive, ""],
    ["disks", simulation.disks, ""],
    ["version", document.documentElement.dataset.version, ""],
    ["seconds", text(end), "s"],
    ["sample", text(sample), "s"],
  ];
  for (const { name, causality, unit, value } of simulation.variables) {
    if (causality !== "output") rows.push([name, text(value), unit]);
  }
  return `${rows.map((row) => row.join(",")).join("\n")}\n`;
}

/** The command that makes the same run. */
export function command({ scene, disks, given }, end, sample) {
  const engine = scene === "wedge" ? " --engine event-driven" : "";
  const count = scene === "wedge" ? "" : ` --disks ${disks}`;
  const set = Object.entries(given).map(([name, value]) => ` --set ${name}=${value}`);
  return `jostle run ${scene}${engine}${count}${set.join("")} --seconds ${end} --sample ${sample}`;
}
