// The scene on a canvas.

import { diverging, sequential } from "jostle/colours";

const INK = "#222";
const FLOOR = "#b9b4a7";

/** Draws frames of a source onto a canvas, at the resolution of the screen. */
export class Stage {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
  }

  /** From metres to pixels: the view as large as it fits, its floor at the bottom. */
  fit(view) {
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [this.canvas.clientWidth * ratio, this.canvas.clientHeight * ratio].map(Math.round);
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    const scale = Math.min(width / (view.right - view.left), height / (view.top - view.bottom));
    const across = 0.5 * (width - scale * (view.left + view.right));
    this.place = { scale, x: (x) => across + scale * x, y: (y) => height + scale * (view.bottom - y), width, height };
  }

  /** One frame: { shapes, x, y, angle, radius, base, shade, contacts, phase }. `shade` has a share for each disk. */
  draw(frame) {
    this.fit(frame.shapes.view);
    const { context, place } = this;
    context.fillStyle = "#fff";
    context.fillRect(0, 0, place.width, place.height);
    this.walls(frame);
    for (let disk = 0; disk < frame.radius.length; disk++) this.disk(frame, disk);
    if (frame.contacts) this.chains(frame);
    this.ruler(frame);
    if (frame.phase !== null) this.phase(frame.phase);
  }

  walls({ shapes, base }) {
    const { context, place } = this;
    const drawn = (lines, lift) => {
      for (const line of lines) {
        context.beginPath();
        line.forEach(([x, y], k) => context[k ? "lineTo" : "moveTo"](place.x(x), place.y(y + lift)));
        context.stroke();
      }
    };
    context.lineWidth = Math.max(2, 0.004 * place.width);
    context.lineJoin = "round";
    context.strokeStyle = "#8a8577";
    drawn(shapes.still, 0);
    context.fillStyle = FLOOR;
    if (shapes.period !== null) this.solid(shapes.moving[0], base);
    context.strokeStyle = INK;
    drawn(shapes.moving, base);
  }

  solid(line, lift) {
    const { context, place } = this;
    context.beginPath();
    context.moveTo(place.x(line[0][0]), place.height);
    for (const [x, y] of line) context.lineTo(place.x(x), place.y(y + lift));
    context.lineTo(place.x(line[line.length - 1][0]), place.height);
    context.fill();
  }

  disk({ shapes, x, y, angle, radius, shade, sense }, disk) {
    const { period } = shapes;
    if (period === null) return this.oneDisk(x[disk], y[disk], radius[disk], angle[disk], shade[disk], sense);
    const inside = x[disk] - period * Math.floor(x[disk] / period);
    this.oneDisk(inside, y[disk], radius[disk], angle[disk], shade[disk], sense);
    // One that crosses the edge of the periodic cell is seen on both sides.
    if (inside < radius[disk]) this.oneDisk(inside + period, y[disk], radius[disk], angle[disk], shade[disk], sense);
    if (inside > period - radius[disk]) this.oneDisk(inside - period, y[disk], radius[disk], angle[disk], shade[disk], sense);
  }

  oneDisk(x, y, radius, angle, shade, sense) {
    const { context, place } = this;
    const [px, py, size] = [place.x(x), place.y(y), radius * place.scale];
    context.beginPath();
    context.arc(px, py, size, 0, 2 * Math.PI);
    context.fillStyle = sense ? diverging(shade) : sequential(shade);
    context.fill();
    context.lineWidth = Math.max(0.8, 0.06 * size);
    context.strokeStyle = INK;
    context.stroke();
    // A darker half, on the right at angle 0, so that one sees it turn: as in the films.
    context.beginPath();
    context.arc(px, py, size, -angle - 0.5 * Math.PI, -angle + 0.5 * Math.PI);
    context.fillStyle = "rgba(0, 0, 0, 0.3)";
    context.fill();
  }

  /** Lines from centre to centre, in proportion to the force; the ruler is as thick as `thick` newtons. */
  chains({ contacts, x, y, thick }) {
    if (!contacts.length) return;
    const { context, place } = this;
    context.strokeStyle = INK;
    context.lineCap = "round";
    for (const contact of contacts) {
      if (!(contact.force > 0.02 * thick)) continue;
      const end = contact.second < 0 ? [contact.x, contact.y] : [x[contact.second], y[contact.second]];
      context.lineWidth = Math.min(0.02, 0.003 * (contact.force / thick)) * place.width;
      context.beginPath();
      context.moveTo(place.x(x[contact.first]), place.y(y[contact.first]));
      context.lineTo(place.x(end[0]), place.y(end[1]));
      context.stroke();
    }
  }

  /** A length to compare with: 1, 2 or 5 times a power of ten, about a fifth of the picture. */
  ruler({ shapes }) {
    const { context, place } = this;
    const about = 0.2 * (shapes.view.right - shapes.view.left);
    const power = 10 ** Math.floor(Math.log10(about));
    const length = power * [5, 2, 1].find((digit) => digit * power <= about);
    const [size, left, top] = [length * place.scale, 0.03 * place.width, 0.035 * place.height];
    context.fillStyle = INK;
    context.fillRect(left, top, size, Math.max(2, 0.003 * place.width));
    context.font = `${Math.max(11, 0.02 * place.width)}px sans-serif`;
    context.textBaseline = "top";
    context.textAlign = "left";
    const text = length < 0.01 ? `${+(1e3 * length).toPrecision(1)} mm` : `${+(100 * length).toPrecision(1)} cm`;
    context.fillText(text, left, top + 0.008 * place.width);
  }

  /** A dial: where the base is in its period. */
  phase(turns) {
    const { context, place } = this;
    const size = 0.025 * place.width;
    const [x, y] = [place.width - 2 * size, 2 * size];
    context.beginPath();
    context.arc(x, y, size, 0, 2 * Math.PI);
    context.lineWidth = 1.5;
    context.strokeStyle = INK;
    context.fillStyle = "#fff";
    context.fill();
    context.stroke();
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(x + size * Math.cos(2 * Math.PI * turns), y - size * Math.sin(2 * Math.PI * turns));
    context.lineWidth = 3;
    context.stroke();
  }
}
