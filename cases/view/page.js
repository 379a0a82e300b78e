// Draws the curves, and lets one look along them: the pointer's time is everywhere the same, and so is the film's.
"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const svgName = "http://www.w3.org/2000/svg";
const size = { width: 560, height: 230, left: 58, right: 10, top: 8, bottom: 34 };
const allTimes = data.times.flat();
const whole = allTimes.length ? [Math.min(...allTimes), Math.max(...allTimes)] : [0, 1];
let shown = [...whole];
let cursor = null;
const charts = [];

function element(name, attributes, parent) {
  const made = document.createElementNS(svgName, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (parent) parent.append(made);
  return made;
}

function ticks(low, high, wanted) {
  const raw = (high - low) / wanted, power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map(factor => factor * power).find(candidate => candidate >= raw);
  const found = [];
  for (let value = Math.ceil(low / step - 1e-9) * step; value <= high + 1e-9 * step; value += step)
    found.push(Math.abs(value) < 1e-9 * step ? 0 : value);
  return found;
}

const text = value => value === null || value === undefined ? "–" : Number(value.toPrecision(4)).toString();
const across = time => size.left + (time - shown[0]) / (shown[1] - shown[0]) * (size.width - size.left - size.right);
const timeAt = x => shown[0] + (x - size.left) / (size.width - size.left - size.right) * (shown[1] - shown[0]);

function nearestRow(times, time) {
  let low = 0, high = times.length - 1;
  while (high - low > 1) { const middle = (low + high) >> 1; if (times[middle] < time) low = middle; else high = middle; }
  return time - times[low] < times[high] - time ? low : high;
}

function draw(chart) {
  const { panel, plot } = chart;
  plot.replaceChildren();
  let low = Infinity, high = -Infinity;
  for (const curve of panel.curves)
    data.times[curve.run].forEach((time, row) => {
      const value = curve.values[row];
      if (value !== null && time >= shown[0] && time <= shown[1]) { low = Math.min(low, value); high = Math.max(high, value); }
    });
  if (!(high >= low)) [low, high] = [0, 1];
  const margin = 0.05 * (high - low) || Math.abs(high) * 0.05 || 1;
  low -= margin; high += margin;
  const up = value => size.height - size.bottom - (value - low) / (high - low) * (size.height - size.top - size.bottom);
  for (const value of ticks(low, high, 4)) {
    element("line", { x1: size.left, x2: size.width - size.right, y1: up(value), y2: up(value), class: "grid" }, plot);
    element("text", { x: size.left - 6, y: up(value) + 4, class: "tick end" }, plot).textContent = text(value);
  }
  for (const time of ticks(shown[0], shown[1], 6)) {
    element("line", { x1: across(time), x2: across(time), y1: size.top, y2: size.height - size.bottom, class: "grid" }, plot);
    element("text", { x: across(time), y: size.height - size.bottom + 16, class: "tick" }, plot).textContent = text(time);
  }
  element("text", { x: size.width - size.right, y: size.height - 3, class: "tick end" }, plot).textContent = "time (ms)";
  const clip = element("g", { "clip-path": "url(#plot-area)" }, plot);
  panel.curves.forEach((curve, number) => {
    let path = "", pen = "M";
    data.times[curve.run].forEach((time, row) => {
      const value = curve.values[row];
      if (value === null) { pen = "M"; return; }
      path += `${pen}${across(time).toFixed(1)},${up(value).toFixed(1)}`; pen = "L";
    });
    element("path", { d: path, class: `curve c${number % 8}` }, clip);
  });
  chart.line = element("line", { y1: size.top, y2: size.height - size.bottom, class: "cursor", visibility: "hidden" }, plot);
  mark(chart);
}

function mark(chart) {
  const inside = cursor !== null && cursor >= shown[0] && cursor <= shown[1];
  chart.line.setAttribute("visibility", inside ? "visible" : "hidden");
  if (inside) { chart.line.setAttribute("x1", across(cursor)); chart.line.setAttribute("x2", across(cursor)); }
  chart.readings.forEach((reading, number) => {
    const curve = chart.panel.curves[number], times = data.times[curve.run];
    reading.textContent = cursor === null ? "" : text(curve.values[nearestRow(times, cursor)]);
  });
}

function setCursor(time, fromFilm) {
  cursor = time;
  charts.forEach(mark);
  document.getElementById("cursor-time").textContent = time === null ? "" : `t = ${text(time)} ms`;
  if (!fromFilm && time !== null) showFrame(nearestRow(data.frame_times, time));
}

function makeChart(panel) {
  const figure = document.createElement("figure");
  const caption = document.createElement("figcaption");
  caption.innerHTML = `<b></b> `;
  caption.firstChild.textContent = panel.label;
  const readings = panel.curves.map((curve, number) => {
    const entry = document.createElement("span");
    entry.className = `entry c${number % 8}`;
    entry.append(curve.legend, " ");
    const reading = document.createElement("output");
    entry.append(reading);
    caption.append(entry);
    return reading;
  });
  const svg = element("svg", { viewBox: `0 0 ${size.width} ${size.height}`, role: "img", "aria-label": panel.label });
  const plot = element("g", {}, svg);
  const band = element("rect", { y: size.top, height: size.height - size.top - size.bottom, class: "band", visibility: "hidden" }, svg);
  figure.append(caption, svg);
  document.getElementById("charts").append(figure);
  const chart = { panel, plot, readings, line: null };
  charts.push(chart);
  const place = event => {
    const box = svg.getBoundingClientRect();
    return Math.min(Math.max((event.clientX - box.left) / box.width * size.width, size.left), size.width - size.right);
  };
  let begun = null;
  svg.addEventListener("pointermove", event => {
    const x = place(event);
    setCursor(timeAt(x), false);
    if (begun !== null) {
      band.setAttribute("visibility", "visible");
      band.setAttribute("x", Math.min(begun, x)); band.setAttribute("width", Math.abs(x - begun));
    }
  });
  svg.addEventListener("pointerdown", event => { begun = place(event); svg.setPointerCapture(event.pointerId); });
  svg.addEventListener("pointerup", event => {
    const x = place(event), from = begun;
    begun = null;
    band.setAttribute("visibility", "hidden");
    if (from !== null && Math.abs(x - from) > 8) {
      shown = [timeAt(Math.min(from, x)), timeAt(Math.max(from, x))];
      charts.forEach(draw);
    }
  });
  svg.addEventListener("pointercancel", () => { begun = null; band.setAttribute("visibility", "hidden"); });
  svg.addEventListener("dblclick", () => { shown = [...whole]; charts.forEach(draw); });
}

let frame = 0, playing = null;
function showFrame(number) {
  if (!data.frame_times.length) return;
  frame = number;
  document.getElementById("frame").src = document.getElementById(`frame-${number}`).textContent;
  document.getElementById("slider").value = number;
  document.getElementById("frame-time").textContent = `${text(data.frame_times[number])} ms`;
}
function setPlaying(on) {
  clearInterval(playing);
  playing = on ? setInterval(() => {
    showFrame((frame + 1) % data.frame_times.length);
    setCursor(data.frame_times[frame], true);
  }, 1000 / data.frame_rate) : null;
  document.getElementById("play").textContent = on ? "pause" : "play";
}

data.panels.forEach(makeChart);
charts.forEach(draw);
if (data.frame_times.length) {
  document.getElementById("play").addEventListener("click", () => setPlaying(playing === null));
  document.getElementById("slider").addEventListener("input", event => {
    setPlaying(false);
    showFrame(Number(event.target.value));
    setCursor(data.frame_times[frame], true);
  });
  showFrame(data.first_frame);
  setCursor(data.frame_times[frame], true);
}
document.documentElement.dataset.ready = charts.length;
