// @ts-check
import { api } from "../api.js";
import { byId, colour } from "../dom.js";
import { said } from "./heat.js";
import { plot, title } from "./plotting.js";
import { digits, titled } from "./results.js";

const LONGEST = 30; // characters of a line of a label beside its bar

/** How strongly the measure depends on each input. @param {string} sweep @param {any} column */
export async function drawTornado(sweep, column) {
  const found = await api.get(`/sweeps/${sweep}/sensitivity?measure=${encodeURIComponent(column.key)}`);
  byId("tornado-title").textContent = `Tornado: ${titled(column)}`;
  const box = byId("tornado");
  const out = found.left_out ? ` ${found.left_out} points that did not complete are left out.` : "";
  byId("tornado-words").textContent = `${found.basis} ${found.points} points.${out}`;
  if (!found.bars.length) return plot(box, [], { annotations: [said("No input varies among the completed points so far.")] });
  const bars = [...found.bars].reverse();
  const names = bars.map((one) => named(one.label));
  const side = (/** @type {"low" | "high"} */ end, /** @type {string} */ name) => ({
    type: "bar",
    orientation: "h",
    name: `${end} end`,
    y: names.map((_, k) => k),
    base: bars.map(() => found.mean),
    x: bars.map((one) => one[end] - found.mean),
    marker: { color: colour(name) },
    text: bars.map((one) => `${digits(one[`${end}_input`])} ${one.unit}`),
    textposition: "outside",
    cliponaxis: false,
    customdata: bars.map((one) => [one.label, digits(one[end]), one.correlation === null ? "–" : one.correlation.toFixed(2)]),
    hovertemplate: `%{customdata[0]} at %{text}: %{customdata[1]} ${column.shown_label}<br>rank correlation %{customdata[2]}<extra></extra>`,
  });
  plot(box, [side("low", "--curve-1"), side("high", "--curve-2")], {
    barmode: "overlay",
    bargap: 0.35,
    xaxis: { ...title(titled(column)), range: padded(found.bars.flatMap((/** @type {any} */ one) => [one.low, one.high, found.mean])) },
    yaxis: { tickvals: names.map((_, k) => k), ticktext: names },
    showlegend: true,
    legend: { orientation: "h", x: 1, xanchor: "right", y: 1.02, yanchor: "bottom" },
    margin: { l: 60, r: 12, t: 24, b: 48 },
  });
}

/** A range with room for the texts at the ends of the bars. @param {number[]} values */
function padded(values) {
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const room = 0.22 * (high - low || Math.abs(high) || 1);
  return [low - room, high + room];
}

/** A label on two lines: the part of the plan, and its field. @param {string} label */
function named(label) {
  const parts = label.split(": ");
  const lines = parts.length > 1 ? [parts[0], parts[parts.length - 1]] : parts;
  return lines.map((line) => (line.length > LONGEST ? `${line.slice(0, LONGEST - 1)}…` : line)).join("<br>");
}
