// Sliders, the table of all parameters, and files for the user.

/** A slider with a label and a number that can be typed. */
function slider({ name, label, shown = "", factor = 1, min, max, step }, app) {
  const now = () => (name === "disks" ? app.state.disks : name === "gamma" ? app.gamma() : app.source.value(name)) * factor;
  const row = document.createElement("label");
  row.title = app.source.simulation?.byName.get(name)?.description ?? label;
  const text = document.createElement("span");
  text.textContent = shown ? `${label} [${shown}]` : label;
  const [range, number] = ["range", "number"].map((type) => Object.assign(document.createElement("input"), { type, step, min, max }));
  number.removeAttribute("min"); // values outside of the slider are allowed: the module checks them
  number.removeAttribute("max");
  number.step = "any";
  for (const input of [range, number]) {
    input.dataset.name = name;
    input.setAttribute("aria-label", label);
  }
  const refresh = () => {
    const value = +now().toPrecision(4);
    range.value = value;
    number.value = value;
  };
  const set = (given) => {
    const value = given === "" ? NaN : Number(given);
    const wanted = `${label} = ${given || "nothing"}`;
    if (Number.isNaN(value)) app.say(`${label}: give a number.`);
    else if (name === "disks" && !Number.isInteger(value)) app.say(`${wanted} is not allowed: a whole number.`);
    else if (!app.change(name, name === "disks" ? value : value / factor)) app.say(`${wanted}: ${app.message()}`);
    app.build();
  };
  range.addEventListener("input", () => (number.value = range.value));
  range.addEventListener("change", () => set(range.value));
  number.addEventListener("change", () => set(number.value));
  refresh();
  row.append(text, range, number);
  return row;
}

/** Fills `place` with the sliders of a scene. */
export function sliders(place, list, app) {
  place.replaceChildren(...list.map((entry) => slider(entry, app)));
}

/** Fills the table `place` with every parameter of the scene. */
export function allParameters(place, app) {
  const { variables } = app.source.simulation;
  const rows = variables.filter(({ causality }) => causality === "parameter");
  place.replaceChildren(
    ...rows.map((variable) => {
      const row = document.createElement("tr");
      row.title = variable.description;
      const [name, value, unit] = ["td", "td", "td"].map((tag) => document.createElement(tag));
      name.textContent = variable.name;
      unit.textContent = variable.unit === "1" ? "" : variable.unit;
      value.append(field(variable, app));
      row.append(name, value, unit);
      return row;
    }),
  );
}

function field({ name, options, value }, app) {
  const input = document.createElement(options.length ? "select" : "input");
  if (options.length) input.append(...options.map((option, index) => new Option(option, index + 1)));
  input.value = value;
  input.dataset.parameter = name;
  input.setAttribute("aria-label", name);
  input.addEventListener("change", () => {
    // As text: the module reads it as the command line does, and says what is wrong with it.
    const given = options.length ? options[input.value - 1] : input.value;
    const number = Number(given);
    app.change(name, given !== "" && !Number.isNaN(number) ? number : given);
    app.build();
  });
  return input;
}

/** Hands the user a file. */
export function save(name, content) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type: "text/csv" }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1e4);
}
