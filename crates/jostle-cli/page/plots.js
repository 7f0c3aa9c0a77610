// Running plots: lines that grow, drawn anew when there is something new.

import { diverging } from "jostle/colours";

const MOST = 600;

/** Samples of several lines over time. When there are too many, every second one goes: the whole run stays in view. */
export class Series {
  constructor(count) {
    this.time = [];
    this.lines = Array.from({ length: count }, () => []);
    this.every = 1;
    this.passed = 0;
  }

  add(time, values) {
    if (this.passed++ % this.every) return;
    this.time.push(time);
    this.lines.forEach((line, k) => line.push(values[k]));
    if (this.time.length <= MOST) return;
    const even = (_, k) => k % 2 === 0;
    this.time = this.time.filter(even);
    this.lines = this.lines.map((line) => line.filter(even));
    this.every *= 2;
  }
}

function ticks(low, high, about) {
  const rough = (high - low) / about;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5].find((digit) => digit * power >= rough) ?? 10);
  const first = Math.ceil(low / step);
  const count = Math.floor(high / step) - first + 1;
  return Array.from({ length: Math.max(0, count) }, (_, k) => +((first + k) * step).toPrecision(12));
}

/** Draws a series with axes. `label` says what is up and in which unit. */
export function plot(canvas, series, label) {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth * ratio, canvas.clientHeight * ratio].map(Math.round);
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  const context = canvas.getContext("2d");
  context.fillStyle = "#fff";
  context.fillRect(0, 0, width, height);
  const size = 11 * ratio;
  const last = series.time[series.time.length - 1] ?? 0;
  const end = Math.max(last, 1e-3);
  const values = series.lines.flat();
  let [low, high] = values.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [0, 0]);
  if (high - low < 1e-12) [low, high] = [low - 1e-3, high + 1e-3];
  const margin = 0.05 * (high - low);
  [low, high] = [low - margin, high + margin];
  const [xTicks, yTicks] = [ticks(0, end, 5), ticks(low, high, 4)];
  context.font = `${size}px sans-serif`;
  const widest = Math.max(...yTicks.map((tick) => context.measureText(`${tick}`).width));
  const box = { left: widest + 1.5 * size, right: width - 2 * size, top: 1.9 * size, bottom: height - 2.4 * size };
  const x = (t) => box.left + ((box.right - box.left) * t) / end;
  const y = (v) => box.bottom - ((box.bottom - box.top) * (v - low)) / (high - low);
  axes(context, { box, x, y, size, xTicks, yTicks, label });
  series.lines.forEach((line, k) => {
    context.beginPath();
    line.forEach((value, n) => context[n ? "lineTo" : "moveTo"](x(series.time[n]), y(value)));
    const latest = line[line.length - 1] ?? 0;
    context.lineWidth = (series.lines.length > 1 ? 1 : 2) * ratio;
    context.strokeStyle = series.lines.length > 1 ? dark(latest / Math.max(Math.abs(low), Math.abs(high)), k) : "#2166ac";
    context.stroke();
  });
  if (series.lines.length > 1) mean(context, series, x, y, ratio);
}

/** The mean of all lines, thick. */
function mean(context, series, x, y, ratio) {
  context.beginPath();
  series.time.forEach((time, n) => {
    const sum = series.lines.reduce((total, line) => total + line[n], 0);
    context[n ? "lineTo" : "moveTo"](x(time), y(sum / series.lines.length));
  });
  context.lineWidth = 2.5 * ratio;
  context.strokeStyle = "#222";
  context.stroke();
}

/** Lines that end high are blue, lines that end low red, those between grey. */
function dark(share, k) {
  return Math.abs(share) < 0.05 ? `hsl(0, 0%, ${45 + (k % 4) * 8}%)` : diverging(Math.sign(share) * Math.max(0.55, Math.abs(share)));
}

function axes(context, { box, x, y, size, xTicks, yTicks, label }) {
  context.lineWidth = 1;
  context.strokeStyle = "#ddd";
  context.fillStyle = "#333";
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (const tick of yTicks) {
    context.beginPath();
    context.moveTo(box.left, y(tick));
    context.lineTo(box.right, y(tick));
    context.stroke();
    context.fillText(`${tick}`, box.left - 0.5 * size, y(tick));
  }
  context.textAlign = "center";
  context.textBaseline = "top";
  for (const tick of xTicks) context.fillText(`${tick}`, x(tick), box.bottom + 0.3 * size);
  context.fillText("time [s]", 0.5 * (box.left + box.right), box.bottom + 1.3 * size);
  context.textAlign = "left";
  context.textBaseline = "top";
  context.fillText(label, 0.5 * size, 0.3 * size);
  context.strokeStyle = "#333";
  context.strokeRect(box.left, box.top, box.right - box.left, box.bottom - box.top);
}
