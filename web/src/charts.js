// Charts as SVG: colours come from the page, so that they are right in light, dark and print.
import * as Plot from "@observablehq/plot";
import { cell, element, heading, rowsOf, text } from "./data.js";
import { behind, shownColumns } from "./table.js";

/** Points drawn of one series; more are thinned, never in the table. */
const MOST = 3000;

export const tone = (name) => `var(--${name ?? "one"})`;

/** Of rows with x and y those to draw: in each of many slices of the rows the least and the greatest y, and the ends. */
export function thinned(rows, y, most = MOST) {
  if (rows.length <= most) return rows;
  const slices = Math.floor(most / 2);
  const kept = [];
  for (let slice = 0; slice < slices; slice += 1) {
    const from = Math.floor((slice * rows.length) / slices);
    const to = Math.floor(((slice + 1) * rows.length) / slices);
    let [low, high] = [rows[from], rows[from]];
    for (let k = from; k < to; k += 1) {
      if (y(rows[k]) < y(low)) low = rows[k];
      if (y(rows[k]) > y(high)) high = rows[k];
    }
    if (low === high) kept.push(low);
    else kept.push(...(rows.indexOf(low, from) < rows.indexOf(high, from) ? [low, high] : [high, low]));
  }
  return kept;
}

function rowsWith(columns) {
  const count = rowsOf({ columns });
  const rows = [];
  for (let row = 0; row < count; row += 1) {
    if (columns.every((column) => cell(column, row) != null)) rows.push(row);
  }
  return rows;
}

/** A picture with a name; its parts, which have no role, have none. */
function named(plot, title) {
  plot.querySelectorAll("[aria-label], [aria-description]").forEach((part) => ["aria-label", "aria-description"].forEach((name) => part.removeAttribute(name)));
  plot.setAttribute("role", "img");
  plot.setAttribute("aria-label", title);
}

/** The marks of one series of a chart: what is drawn, from which columns of the table. */
function marksOf(series, columns, alone) {
  const of = (index) => columns[index];
  const colour = tone(series.tone);
  const at = (index) => (row) => cell(of(index), row);
  const used = [series.x, series.x2, series.y, series.y2].filter((index) => index != null).map(of);
  const rows = rowsWith(used);
  const [x, y] = [at(series.x), at(series.y)];
  switch (series.kind) {
    case "line":
      return [Plot.line(thinned(rows, y), { x, y, stroke: colour, strokeWidth: 1.5 })];
    case "histogram":
      // several on one axis are seen through one another
      return [Plot.rectY(rows.filter((row) => y(row) > 0), { x1: x, x2: at(series.x2), y, fill: colour, fillOpacity: alone ? 1 : 0.35, stroke: alone ? "none" : colour, inset: alone ? 0.4 : 0 })];
    case "bars":
      return [Plot.barY(rows, { x, y, fill: colour, fillOpacity: 0.85 })];
    case "rows":
      return [
        Plot.ruleX([0]),
        Plot.barX(rows, { x: y, y: x, fill: colour, fillOpacity: 0.85, sort: null }),
        ...(series.y2 == null ? [] : [Plot.ruleY(rows, {
          y: x, x1: (row) => y(row) - at(series.y2)(row), x2: (row) => y(row) + at(series.y2)(row), stroke: "currentColor", strokeWidth: 1.2,
        })]),
      ];
    case "level":
      return [Plot.ruleY(rows, { y, stroke: colour, strokeDasharray: "5 3", strokeWidth: 1.5 })];
    default:
      return [Plot.dot(thinned(rows, y), { x, y, fill: colour, fillOpacity: 0.75, r: rows.length > 600 ? 1.6 : 2.6 })];
  }
}

function legend(series) {
  const named = series.filter((one) => one.name);
  if (named.length < 2) return null;
  const entries = named.map((one) => element("li", {}, element("i", { style: `background:${tone(one.tone)}` }), one.name));
  return element("ul", { className: "legend" }, ...entries);
}

/** Boxes that have not been near the window yet. */
const later = new Set();
const near = new IntersectionObserver((entries) => {
  for (const { target, isIntersecting } of entries) if (isIntersecting) target.dispatchEvent(new Event("near"));
}, { rootMargin: "500px" });

/** Draws what has not been seen: paper has all. */
function drawAll() {
  for (const box of [...later]) box.dispatchEvent(new Event("near"));
}
addEventListener("beforeprint", drawAll);
matchMedia("print").addEventListener("change", (event) => event.matches && drawAll());

/** Draws into a box of about a height, when it comes near the window and whenever its width changes. */
function responsive(draw, height) {
  const box = element("div", { className: "plot", style: `min-height:${height}px` });
  let last = 0;
  const redraw = () => {
    const width = Math.round(box.clientWidth);
    if (width > 0 && width !== last) {
      last = width;
      box.replaceChildren(draw(width));
      box.style.minHeight = "";
    }
  };
  later.add(box);
  near.observe(box);
  box.addEventListener("near", () => {
    if (!later.delete(box)) return;
    near.unobserve(box);
    new ResizeObserver(redraw).observe(box);
    redraw();
  });
  return box;
}

const pen = document.createElement("canvas").getContext("2d");

/** Names that fit into so many pixels, and how many the longest takes: the middle of a longer one is left out, the table has it all. */
function fitted(names, size, most) {
  pen.font = `${size}px ${getComputedStyle(document.body).fontFamily}`;
  const wide = (text) => pen.measureText(text).width;
  const short = (name) => {
    if (wide(name) <= most) return name;
    let kept = name.length - 1;
    const cut = () => `${name.slice(0, Math.ceil(kept / 2))}\u2026${name.slice(name.length - Math.floor(kept / 2))}`;
    while (kept > 4 && wide(cut()) > most) kept -= 1;
    return cut();
  };
  const shown = names.map(short);
  return { shown: (index) => shown[index], widest: Math.max(20, ...shown.map(wide)) };
}

/** Rows that one press of a key steps over. */
const LEAP = 10;

/**
 * Makes a chart's points choosable by keys: a slider along `stops`, rows in the order of x. `words(row)` says a row in words. The
 * result has `at(row)`, to say which is chosen.
 */
function walked(box, stops, words, onselect) {
  let at = 0;
  const say = () => {
    box.setAttribute("aria-valuenow", String(at));
    box.setAttribute("aria-valuetext", words(stops[at]));
  };
  const steps = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: LEAP, PageDown: -LEAP, Home: -Infinity, End: Infinity };
  box.setAttribute("aria-valuemin", "0");
  box.setAttribute("aria-valuemax", String(stops.length - 1));
  box.addEventListener("keydown", (event) => {
    if (!(event.key in steps)) return;
    event.preventDefault();
    at = Math.max(0, Math.min(stops.length - 1, at + steps[event.key]));
    onselect(stops[at]);
    say();
  });
  say();
  return { at: (row) => {
    const found = stops.indexOf(row);
    if (found >= 0) at = found;
    say();
  } };
}

/**
 * A chart of columns of a table, with its table behind it. `onselect(row)` is called when a point is chosen, by a click or by keys
 * that walk along `stops`; the result has `mark(row)`, which rings the chosen one.
 */
export function showChart(chart, table, onselect, stops) {
  const columns = table.columns;
  const rows = chart.series.some((series) => series.kind === "rows");
  const label = (axis) => (axis?.unit ? `${axis.label}, ${axis.unit}` : axis?.label);
  const picked = chart.series.find((series) => series.kind === "line" || series.kind === "dots");
  const draw = (width) => {
    const marks = [Plot.ruleY(rows ? [] : [0], { strokeOpacity: 0.3 })];
    for (const series of chart.series) marks.push(...marksOf(series, columns, chart.series.length === 1));
    if (picked) {
      const all = thinned(rowsWith([columns[picked.x], columns[picked.y]]), (row) => cell(columns[picked.y], row));
      const channels = { x: (row) => cell(columns[picked.x], row), y: (row) => cell(columns[picked.y], row) };
      marks.push(Plot.tip(all, Plot.pointer({
        ...channels,
        title: (row) => columns.filter((column) => !column.hidden).slice(0, 6).map((column) => `${heading(column)}: ${cell(column, row) ?? "\u2013"}`).join("\n"),
      })));
    }
    const count = rowsOf(table);
    const counted = chart.series.filter((series) => series.kind === "histogram");
    const highest = counted.length ? Math.max(...counted.flatMap((series) => Array.from({ length: count }, (_, row) => cell(columns[series.y], row)))) : Infinity;
    const names = rows || chart.bands ? Array.from({ length: count }, (_, row) => String(cell(columns[chart.series[0].x], row))) : [];
    const labels = rows ? fitted(names, 12, width * 0.6) : null;
    const plot = Plot.plot({
      width,
      height: rows ? 60 + 20 * count : chart.height ?? 260,
      marginLeft: rows ? labels.widest + 14 : 56,
      marginTop: 30,
      marginBottom: 46,
      style: { background: "transparent", fontSize: "12px", overflow: "visible" },
      x: rows ? { label: label(chart.y), grid: true } : { label: label(chart.x), type: chart.bands ? "band" : chart.x.log ? "log" : undefined, tickFormat: chart.x.log ? "~g" : undefined, domain: chart.bands ? names : undefined },
      y: rows ? { label: null, type: "band", domain: names, tickFormat: (_, index) => labels.shown(index) } : { label: label(chart.y), grid: true, zero: true, nice: true, ticks: Math.min(highest, 5) },
      marks,
    });
    named(plot, chart.title);
    if (onselect) {
      plot.addEventListener("click", () => {
        if (plot.value != null) onselect(plot.value);
      });
      plot.style.cursor = "pointer";
    }
    scales = { x: plot.scale("x"), y: plot.scale("y") };
    current = plot;
    ring();
    return plot;
  };
  let [scales, current, chosen] = [null, null, -1];
  /** Rings round the chosen row's points. */
  const ring = () => {
    if (!current) return;
    current.querySelectorAll(".chosen").forEach((one) => one.remove());
    for (const series of chosen >= 0 ? chart.series : []) {
      if (series.kind !== "dots" && series.kind !== "line") continue;
      const [x, y] = [cell(columns[series.x], chosen), cell(columns[series.y], chosen)];
      if (x == null || y == null) continue;
      const circle = document.createElementNS("http://www.w3.org/2000/svg", "circle");
      for (const [name, value] of Object.entries({ class: "chosen", cx: scales.x.apply(x), cy: scales.y.apply(y), r: 6 })) circle.setAttribute(name, value);
      current.append(circle);
    }
  };
  const box = responsive(draw, rows ? 60 + 20 * rowsOf(table) : 260);
  let walk = null;
  if (onselect && picked) {
    let known = null;
    const words = (row) => (known ??= shownColumns(table)).filter((column) => ![null, undefined, ""].includes(cell(column, row))).slice(0, 6).map((column) => `${heading(column)} ${text(cell(column, row), column)}`).join(", ");
    const across = columns[picked.x];
    // every row that any of the series draws
    const byX = () => [...new Set(chart.series.flatMap((series) => rowsWith([across, columns[series.y]])))].sort((a, b) => cell(across, a) - cell(across, b));
    // made when the chart is reached: a long program's numbers are not worked out before
    box.tabIndex = 0;
    box.setAttribute("role", "slider");
    box.setAttribute("aria-label", `${chart.title}: arrow keys choose a point`);
    box.setAttribute("aria-valuenow", "0");
    box.addEventListener("focus", () => {
      walk ??= walked(box, stops?.() ?? byX(), words, onselect);
      walk.at(chosen);
    });
  }
  const figure = element(
    "figure",
    { className: chart.wide ? "chart wide" : "chart" },
    element("figcaption", {}, element("h3", {}, chart.title), chart.note ? element("p", {}, chart.note) : null),
    legend(chart.series),
    box,
    behind(() => table, chart.title),
  );
  figure.mark = (row) => {
    chosen = row;
    ring();
    walk?.at(row);
  };
  return figure;
}

/** A square of correlations, each cell from -1 to 1. */
export function showHeat(heat) {
  const names = heat.names;
  const cells = [];
  for (let i = 0; i < names.length; i += 1) {
    for (let j = 0; j < names.length; j += 1) {
      const value = heat.values[Math.max(i, j)][Math.min(i, j)];
      if (value != null) cells.push({ i, j, value });
    }
  }
  const draw = (width) => {
    const labels = fitted(names, 11, width * 0.35);
    const margin = labels.widest + 12;
    const step = Math.max(6, Math.min(26, (width - margin - 10) / names.length));
    const small = step < 11;
    const plot = Plot.plot({
      width: margin + 10 + step * names.length,
      height: margin + 10 + step * names.length,
      marginLeft: margin,
      marginTop: margin,
      marginRight: 10,
      marginBottom: 10,
      style: { background: "transparent", fontSize: small ? "8px" : "11px" },
      x: { axis: "top", type: "band", domain: names.map((_, i) => i), tickFormat: (i) => labels.shown(i), tickRotate: -90, label: null, padding: 0.04 },
      y: { type: "band", domain: names.map((_, i) => i), tickFormat: (i) => labels.shown(i), label: null, padding: 0.04 },
      marks: [
        Plot.cell(cells, { x: "j", y: "i", fill: "none", stroke: "currentColor", strokeOpacity: 0.1 }),
        Plot.cell(cells, { x: "j", y: "i", fill: { value: (c) => tone(c.value < 0 ? "after" : "before"), scale: null }, fillOpacity: { value: (c) => Math.abs(c.value), scale: null } }),
        Plot.tip(cells, Plot.pointer({ x: "j", y: "i", title: (c) => `${names[c.i]}\n${names[c.j]}\n${c.value}` })),
      ],
    });
    named(plot, heat.title);
    return plot;
  };
  const table = () => {
    const pairs = cells.filter((c) => c.i > c.j);
    return {
      columns: [
        { label: "one", values: pairs.map((c) => names[c.i]) },
        { label: "other", values: pairs.map((c) => names[c.j]) },
        { label: "correlation", values: pairs.map((c) => c.value) },
      ],
    };
  };
  const scale = element("div", { className: "scale heat" }, element("span", {}, "\u22121"), element("i"), element("span", {}, "+1"));
  return element(
    "figure",
    { className: "chart wide" },
    element("figcaption", {}, element("h3", {}, heat.title), heat.note ? element("p", {}, heat.note) : null),
    scale,
    responsive(draw, 420),
    behind(table, heat.title),
  );
}
