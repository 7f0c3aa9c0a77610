// The page: controls, the loop that advances and draws, links, files.

import { Scale } from "jostle/colours";
import { amplitudeOf, gammaOf, SLIDERS, SLOWNESS } from "jostle/controls";
import { Stage } from "jostle/draw";
import { allParameters, save, sliders } from "jostle/form";
import { Module, Refused } from "jostle/module";
import { plot, Series } from "jostle/plots";
import { command, recorded } from "jostle/record";
import { Recording } from "jostle/replay";
import { Live, Played } from "jostle/sources";

const $ = (id) => document.getElementById(id);
/** Most milliseconds of a frame that the engine may take: the rest is for drawing. */
const PATIENCE = 11;
/** Smallest spin [rad/s] and speed [m/s] that has the full colour. */
const SMALLEST = 0.01;
/** How long a recorded run takes on the screen at first [s]. */
const LENGTH = 10;

class App {
  constructor(module) {
    this.module = module;
    this.scenes = module.scenes();
    this.stage = new Stage($("stage"));
    this.paused = false;
    this.frames = 0;
    const played = new Option("recorded run", "");
    played.hidden = true;
    $("scene").append(played, ...this.scenes.map(({ scene }) => new Option(scene, scene)));
    this.listen();
    this.follow(location.hash || document.documentElement.dataset.start);
    if ($("samples")) this.play(embedded());
    requestAnimationFrame((now) => this.loop(now));
  }

  /** The state of the page that a link holds: #scene=ratchet&disks=30&drive.frequency=25&slow=10&colour=spin. */
  follow(hash) {
    const link = Object.fromEntries(new URLSearchParams(hash.replace(/^#/, "")));
    const { scene = "packing", disks, slow, colour = "spin", chains = "1", ...given } = link;
    const found = this.scenes.find((row) => row.scene === scene) ?? this.scenes[0];
    $("slow").value = slow ?? SLOWNESS[found.scene];
    if (!$("slow").value) $("slow").value = SLOWNESS[found.scene];
    $("colour").value = ["spin", "speed", "none"].includes(colour) ? colour : "spin";
    $("chains").checked = chains !== "0";
    this.choose(found.scene, disks ? +disks : found.usual, given);
    if (found.scene !== scene) this.say(`The link names a scene ${scene}. There are ${this.scenes.map((row) => row.scene).join(", ")}.`);
  }

  /** Another scene, with the start values of the page where nothing is given. */
  choose(scene, disks, given) {
    const start = { ...given };
    const usual = SLIDERS[scene].find(({ name }) => name === "gamma").usual;
    this.state = { scene, disks, given: start };
    const refused = this.restart() ? "" : $("message").textContent;
    if (refused) {
      this.state = { scene, disks: this.scenes.find((row) => row.scene === scene).usual, given: {} };
      this.restart(true);
    }
    if (usual !== undefined && !("drive.amplitude" in this.state.given)) this.change("gamma", usual);
    if (refused) this.say(refused);
    this.build();
  }

  /** A parameter, gamma or disks, in SI units. False and a message if it is refused; all is then as before. */
  change(name, value) {
    const before = this.state;
    const given = { ...before.given };
    const number = (parameter) => this.source.value(parameter);
    if (name === "disks") this.state = { ...before, disks: value };
    else if (name === "gamma") {
      given["drive.amplitude"] = amplitudeOf(value, number("drive.frequency"), number("gravity"));
      this.state = { ...before, given };
    } else {
      // At another frequency the base is as strong as before: Gamma stays, the amplitude follows.
      if (name === "drive.frequency") given["drive.amplitude"] = amplitudeOf(this.gamma(), value, number("gravity"));
      given[name] = value;
      this.state = { ...before, given };
    }
    if (this.restart()) return true;
    this.state = before;
    return false;
  }

  gamma() {
    return gammaOf(...["drive.amplitude", "drive.frequency", "gravity"].map((name) => this.source.value(name)));
  }

  /** Starts anew from the state. With `surely` an error is one of the page and goes up. */
  restart(surely = false) {
    try {
      const source = new Live(this.module, this.state);
      this.show(source);
      return true;
    } catch (error) {
      if (surely || !(error instanceof Refused)) throw error;
      this.say(error.message);
      return false;
    }
  }

  show(source) {
    if (this.source !== source) this.source?.close();
    this.source = source;
    this.scale = new Scale(SMALLEST);
    this.say(source.warnings);
    const disks = source.radius.length;
    this.angles = new Series(Math.min(disks, 60));
    this.transport = new Series(1);
    this.from = null;
    const live = source instanceof Live;
    document.body.classList.toggle("replay", !live);
    document.body.classList.toggle("no-contacts", !live || !source.simulation.has("contacts"));
    $("scene").value = live ? source.scene : "";
    if (!live) {
      Object.assign($("time-slider"), { min: source.time, max: source.end });
      const slow = LENGTH / Math.max(1e-9, source.end - source.time);
      const options = [...$("slow").options].map(({ value }) => Number(value));
      $("slow").value = options.reduce((best, one) => (Math.abs(Math.log(one / slow)) < Math.abs(Math.log(best / slow)) ? one : best));
      this.pause(false);
    }
    history.replaceState(null, "", live ? this.link() : location.pathname + location.search);
    this.look();
  }

  /** From the start: a scene with its parameters, a recorded run with its first sample. */
  again() {
    if (this.source instanceof Live) return this.restart();
    this.source.rewind();
    this.show(this.source);
    return true;
  }

  play(files) {
    Recording.of(files)
      .then((recording) => this.show(new Played(this.module, recording)))
      .catch((error) => this.say(error.message));
  }

  link() {
    const { scene, disks, given } = this.state;
    const view = { slow: $("slow").value, colour: $("colour").value, chains: $("chains").checked ? 1 : 0 };
    return `#${new URLSearchParams({ scene, disks, ...given, ...view })}`;
  }

  loop(now) {
    const passed = Math.min(0.1, (now - (this.now ?? now)) / 1e3);
    this.now = now;
    this.frames += 1;
    if (!this.paused && !this.busy) this.advance(passed / Number($("slow").value));
    requestAnimationFrame((next) => this.loop(next));
  }

  /** Advances by so many seconds and draws. */
  advance(seconds) {
    const { source } = this;
    const wanted = source.time + seconds;
    try {
      source.advance(wanted, PATIENCE);
    } catch (error) {
      this.pause(true);
      const much = error.message.includes("more than one call may do");
      this.say(much ? "This scene takes too many time steps for a page: stiff or damped contacts make the time step small. jostle run can do it." : error.message);
    }
    if (source.time >= source.end) this.pause(true);
    $("late").hidden = !(source.time < Math.min(wanted, source.end) - 1e-12);
    this.look();
  }

  /** Draws what is there now. */
  look() {
    const { source } = this;
    const frame = source.frame($("chains").checked);
    const colour = $("colour").value;
    const numbers = colour === "speed" ? frame.speed : frame.spin;
    const size = this.scale.include(numbers);
    const shade = colour === "none" ? numbers.map(() => 0) : numbers.map((number) => number / size);
    this.stage.draw({ ...frame, shade, sense: colour !== "speed" });
    $("clock").textContent = `${frame.time.toFixed(3)} s`;
    $("time-slider").value = frame.time;
    this.legend(colour, size);
    this.measure(frame);
  }

  legend(colour, size) {
    const digits = (number) => +number.toPrecision(2);
    const turns = digits((60 * size) / (2 * Math.PI));
    const texts = {
      spin: `blue: counter-clockwise, red: clockwise; full colour at ${digits(size)} rad/s, ${turns} turns a minute. `,
      speed: `white: at rest, full blue at ${digits(100 * size)} cm/s. `,
      none: "",
    };
    const lines = this.source instanceof Live && this.source.thick > 0 && $("chains").checked;
    $("legend").textContent = texts[colour] + (lines ? `A line of force as thick as the ruler: ${digits(this.source.thick)} N.` : "");
    const gamma = this.source.value("drive.amplitude") === undefined ? NaN : this.gamma();
    $("gamma-now").textContent = Number.isFinite(gamma) ? `Gamma = ${gamma.toFixed(2)}` : "";
  }

  measure({ x, angle, time }) {
    if (this.from === null) this.from = { x: x.slice(), angle: angle.slice(), time };
    if (time <= this.measured && this.angles.time.length) return;
    this.measured = time;
    const turns = Array.from(this.angles.lines, (_, disk) => (angle[disk] - this.from.angle[disk]) / (2 * Math.PI));
    this.angles.add(time, turns);
    const mean = x.reduce((sum, place, disk) => sum + place - this.from.x[disk], 0) / x.length;
    this.transport.add(time, [1e3 * mean]);
    if (this.frames % 6 !== 0 && !this.paused) return;
    plot($("turns"), this.angles, this.angles.lines.length > 1 ? "turns of each disk, thick: their mean" : "turns of the disk");
    plot($("transport"), this.transport, "mean displacement to the right [mm]");
  }

  pause(paused) {
    this.paused = paused;
    $("pause").textContent = paused ? "Run" : "Pause";
  }

  /** Pauses, or goes on; at the end of a recorded run from its start. */
  goOn() {
    if (this.paused && this.source.time >= this.source.end) this.again();
    else this.pause(!this.paused);
  }

  step() {
    this.pause(true);
    this.advance(1 / 60 / Number($("slow").value));
  }

  /** What is said now. */
  message() {
    return $("message").textContent;
  }

  say(text) {
    $("message").textContent = text;
    $("message").hidden = !text;
  }

  build() {
    sliders($("sliders"), SLIDERS[this.state.scene], this);
    allParameters($("parameters"), this);
  }

  async export() {
    if (this.busy) {
      this.cancelled = true;
      return;
    }
    const end = Number(this.source.time.toFixed(9));
    if (!(end > 0)) return this.say("Nothing has run yet: run or step first.");
    const sample = Number($("sample").value);
    if (!(sample > 0)) return this.say("The time from row to row: give seconds above 0, such as 0.01.");
    this.busy = true;
    this.cancelled = false;
    $("export").textContent = "Cancel";
    try {
      const files = await recorded(this.module, this.state, end, sample, async (share) => {
        this.say(`Computing the run from its start: ${Math.round(100 * share)} %`);
        await new Promise((done) => setTimeout(done));
        return !this.cancelled;
      });
      if (files === null) return this.say("Cancelled: nothing is saved.");
      save("run.csv", files.samples);
      save("run.parameters.csv", files.parameters);
      this.say(`Saved run.csv and run.parameters.csv. The same run: ${command(this.state, end, sample)}`);
    } catch (error) {
      this.say(error.message);
    } finally {
      this.busy = false;
      $("export").textContent = "Save the run";
    }
  }

  listen() {
    const click = { pause: () => this.goOn(), step: () => this.step(), restart: () => this.again(), export: () => this.export() };
    for (const [id, action] of Object.entries(click)) $(id).addEventListener("click", action);
    $("scene").addEventListener("change", () => {
      $("slow").value = SLOWNESS[$("scene").value];
      this.pause(false);
      const { scene, usual } = this.scenes.find((row) => row.scene === $("scene").value);
      this.choose(scene, usual, {});
    });
    for (const id of ["slow", "colour", "chains"]) {
      $(id).addEventListener("change", () => {
        this.scale = new Scale(SMALLEST);
        if (this.source instanceof Live) history.replaceState(null, "", this.link());
        this.look();
      });
    }
    $("share").addEventListener("click", async () => {
      const copied = await navigator.clipboard?.writeText(location.href).then(() => true, () => false);
      this.say(copied ? "The link to this scene is copied." : `The link to this scene: ${location.href}`);
    });
    $("picture").addEventListener("click", () => $("stage").toBlob((blob) => save("jostle.png", blob)));
    $("files").addEventListener("change", () => this.play([...$("files").files]));
    $("time-slider").addEventListener("input", () => {
      this.pause(true);
      this.source.advance(Number($("time-slider").value));
      this.look();
    });
    window.addEventListener("hashchange", () => this.follow(location.hash));
    window.addEventListener("resize", () => this.look());
    window.addEventListener("keydown", ({ key, target }) => {
      if (["INPUT", "SELECT", "BUTTON", "SUMMARY"].includes(target.tagName)) return;
      if (key === " ") this.goOn();
      if (key === "s") this.step();
      if (key === "r") this.again();
    });
  }
}

/** The recorded run that `jostle view` put into the page. */
function embedded() {
  return ["samples", "parameters-file"].map((id) => {
    const element = $(id);
    return new File([element.textContent], element.dataset.name);
  });
}

/** The bytes that a text in base64 holds, compressed by gzip. */
async function unpacked(text) {
  const packed = Uint8Array.from(atob(text.trim()), (character) => character.charCodeAt(0));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

try {
  window.jostle = new App(await Module.load(await unpacked($("module").textContent)));
  document.body.dataset.ready = "yes";
} catch (error) {
  $("message").hidden = false;
  $("message").textContent = error.message;
}
