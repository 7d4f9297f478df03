// A view in space with its list of items, what is known of the chosen one, and the slider that magnifies deviations.
import { cell as valueOf, element, heading, rowsOf, text } from "./data.js";
import { showChart, tone } from "./charts.js";
import { View, ramp } from "./scene.js";
import { behind, showTable } from "./table.js";

const TIMES = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000];

/** A magnification with which the largest deviation is a tenth of the paths' extent. */
function startTimes(cell) {
  let [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  let most = 0;
  for (const path of cell.paths) {
    if (path.like == null) {
      for (let k = 0; k < path.at.length; k += 1) {
        const [x, axis] = [path.at[k], k % 3];
        if (x < low[axis]) low[axis] = x;
        if (x > high[axis]) high[axis] = x;
      }
    }
    if (!path.off) most = Math.max(most, path.worst ?? 0);
  }
  if (!cell.paths.length) {
    cell.points.at.forEach((x, k) => {
      if (x == null) return;
      low[k % 3] = Math.min(low[k % 3], x);
      high[k % 3] = Math.max(high[k % 3], x);
    });
  }
  for (const { axes } of cell.ellipsoids ?? []) most = Math.max(most, ...axes.map(Math.abs));
  const extent = Math.hypot(...high.map((x, axis) => x - low[axis]));
  if (!(most > 0) || !Number.isFinite(extent)) return 0;
  const wished = (0.1 * extent) / most;
  let best = 0;
  TIMES.forEach((times, index) => {
    if (times <= wished) best = index;
  });
  return best;
}

/** Adds to paths that share the places of another one these places, and the size of each deviation. */
export function complete(cell) {
  for (const path of cell.paths) {
    if (!path.at) {
      const other = cell.paths[path.like];
      path.at = other.at;
      path.starts = other.starts;
      path.items = other.items;
    }
    if (path.by) {
      path.worst = 0;
      path.error = new Float64Array(path.at.length / 3);
      for (let k = 0; k < path.error.length; k += 1) {
        const [x, y, z] = [path.by[3 * k], path.by[3 * k + 1], path.by[3 * k + 2]];
        path.error[k] = Math.sqrt(x * x + y * y + z * z);
        if (path.error[k] > path.worst) path.worst = path.error[k];
      }
    }
  }
  return cell;
}

function controls(view, cell) {
  const bar = element("div", { className: "controls" });
  const graded = cell.paths.some((path) => path.by) || (cell.ellipsoids ?? []).length > 0;
  let apply = () => {};
  if (graded) {
    const shown = element("output", {});
    const slider = element("input", { type: "range", min: "0", max: String(TIMES.length - 1), step: "1", className: "magnify", "aria-label": "Magnify deviations" });
    slider.value = String(startTimes(cell));
    apply = (event) => {
      const times = TIMES[Number(slider.value)];
      shown.textContent = `\u00d7${times}`;
      slider.setAttribute("aria-valuetext", `times ${times}`);
      view?.magnify(times, event != null);
    };
    slider.addEventListener("input", apply);
    bar.append(element("label", {}, "Deviations ", slider, shown));
  }
  if (view) {
    for (const shown of view.layers.paths) {
      shown.lines.visible = !shown.path.off;
      const box = element("input", { type: "checkbox", checked: !shown.path.off, onchange: () => {
        shown.lines.visible = box.checked;
        view.draw();
      } });
      const key = shown.path.graded ? null : element("i", { className: "key", style: `background:${tone(shown.path.tone)}` });
      bar.append(element("label", {}, box, key, ` ${shown.path.name}`));
    }
    const toggles = [["robot", view.robot?.group], ["cell", cell.bodies.length ? view.solids : null], [cell.points.name, view.items]];
    for (const [name, object] of toggles) {
      if (!object) continue;
      const box = element("input", { type: "checkbox", checked: true, onchange: () => {
        object.visible = box.checked;
        view.draw();
      } });
      bar.append(element("label", {}, box, ` ${name}`));
    }
    const from = { Corner: [1, -1.2, 0.75], Front: [1, 0, 0.02], Side: [0, -1, 0.02], Top: [0, -0.001, 1] };
    const views = element("span", { className: "views" });
    for (const [name, direction] of Object.entries(from)) views.append(element("button", { type: "button", onclick: () => view.view(direction) }, name));
    if (cell.paths.length) views.append(element("button", { type: "button", onclick: () => view.near() }, "Closer"));
    bar.append(views);
  }
  return { bar, apply };
}

/** What the colours of something say: from 0 to the worst. */
function scaleBar(what, worst) {
  const stops = Array.from({ length: 11 }, (_, k) => ramp(k / 10)).join(", ");
  const digits = worst >= 1 ? 2 : Math.min(6, 1 - Math.floor(Math.log10(worst)));
  return element("div", { className: "scale" }, element("b", {}, what), element("span", {}, "0"), element("i", { style: `background: linear-gradient(to right, ${stops})` }), element("span", {}, `${worst.toFixed(digits)} mm`));
}

/** The scales of what is coloured by size: of the points, where a word says what their colour is, and of the paths. */
function scales(view, cell) {
  const bars = [];
  if (cell.points.by && view.most > 0) bars.push(scaleBar(`${cell.points.name}: ${cell.points.by}`, view.most));
  if (cell.paths.some((path) => path.graded && path.worst > 0)) bars.push(scaleBar("paths: error", view.worst));
  return bars;
}

/** What is known of an item: its line of the program, its numbers, its findings. */
function detailOf(box, cell, table, findings) {
  return (row) => {
    const list = element("dl", {});
    for (const column of table.columns) {
      if (column.code || column.hidden) continue;
      const value = valueOf(column, row);
      if (value == null || value === "") continue;
      list.append(element("dt", {}, heading(column)), element("dd", {}, text(value, column)));
    }
    const code = table.columns.find((column) => column.code);
    const line = table.columns.find((column) => column.label === "line");
    const shown = [];
    if (code && valueOf(code, row) != null) {
      const number = line ? element("span", { className: "lineno" }, `${valueOf(line, row)}  `) : null;
      shown.push(element("pre", { className: "code" }, number, valueOf(code, row)));
    }
    const { joints } = cell.points;
    const listed = table.columns.some((column) => column.label === "joint 1");
    if (!listed && joints && joints[6 * row] != null) {
      list.append(element("dt", {}, "joints, deg"), element("dd", {}, joints.slice(6 * row, 6 * row + 6).map((q) => text(q)).join("  ")));
    }
    const own = findings(row);
    const { external, at } = cell.points;
    const axes = (external?.length ?? 0) / (at.length / 3);
    if (axes) list.append(element("dt", {}, "external axes, mm or deg"), element("dd", {}, external.slice(axes * row, axes * (row + 1)).map((e) => (e == null ? "?" : text(e))).join("  ")));
    const said = own.map((finding) => element("li", { className: "severity " + finding.severity }, `${finding.severity} ${finding.id}: ${finding.message}`));
    box.replaceChildren(...shown, list, said.length ? element("ul", { className: "found" }, ...said) : "");
  };
}

/** The length of the path up to each place, mm. */
function lengths(at) {
  let total = 0;
  return Array.from({ length: at.length / 3 }, (_, k) => {
    if (k > 0) total += Math.hypot(at[3 * k] - at[3 * k - 3], at[3 * k + 1] - at[3 * k - 2], at[3 * k + 2] - at[3 * k - 1]);
    return Number(total.toFixed(2));
  });
}

/** Error along the paths: against the length of the path. */
function along(cell, onselect) {
  const paths = cell.paths.filter((path) => path.by && path.items);
  if (!paths.length || cell.along === false) return null;
  const longest = Math.max(...paths.map((path) => path.error.length));
  // numbers are made when the chart or its table is seen
  const column = (label, of) => {
    let values = null;
    return { label, unit: "mm", get values() {
      if (!values) {
        values = of();
        while (values.length < longest) values.push(null);
      }
      return values;
    } };
  };
  const columns = [];
  const series = [];
  for (const path of paths) {
    const same = path.like != null && columns.length;
    const lengthName = paths.length > 1 && columns.length ? `path length (${path.name})` : "path length";
    const x = same ? 0 : columns.push(column(lengthName, () => lengths(path.at))) - 1;
    const y = columns.push(column(path.name, () => Array.from(path.error, (e) => Number(e.toPrecision(4))))) - 1;
    series.push({ kind: "line", x, y, name: path.name, tone: path.tone });
  }
  const items = paths[0].items;
  const chart = { title: "Error along the path", note: cell.along, wide: true, x: { label: "path length", unit: "mm" }, y: { label: "error", unit: "mm" }, series };
  // one stop for each item: the sample where it begins
  const stops = () => Array.from(new Map(items.map((item, sample) => [item, sample]).reverse()).values()).sort((a, b) => a - b);
  return showChart(chart, { columns }, (sample) => onselect(items[sample]), stops);
}

/** Shows a cell with its list. */
export function showCell(cell, table, findings, onselect) {
  complete(cell);
  const stage = element("div", { className: "stage" });
  const detail = element("div", { className: "detail", tabIndex: 0, role: "region", "aria-label": "What is chosen", "aria-live": "polite" });
  const show = detailOf(detail, cell, table, findings);
  let view = null;
  let list = null;
  const items = cell.paths.find((path) => path.by && path.items)?.items ?? [];
  const chart = along(cell, (row) => select(row));
  const select = (row, fromList = false) => {
    if (row == null || row < 0 || row >= rowsOf(table)) return;
    show(row);
    view?.select(row);
    if (!fromList) list?.select(row);
    chart?.mark(items.indexOf(row));
    onselect(row);
  };
  try {
    view = new View(stage, cell, (row) => select(row));
  } catch {
    stage.append(element("p", { className: "missing" }, "This browser shows no WebGL: the view in space is left out. Charts and tables are complete."));
  }
  list = showTable(table, { title: cell.points.title, onselect: (row) => select(row, true), page: 15 });
  const { bar, apply } = controls(view, cell);
  const parts = [element("h2", {}, cell.title)];
  if (cell.note) parts.push(element("p", {}, cell.note));
  parts.push(bar, element("div", { className: "cell" }, element("div", { className: "space" }, stage, ...(view ? scales(view, cell) : [])), detail), element("h3", {}, cell.points.title), list.node);
  const node = element("section", {}, ...parts);
  if (chart) node.append(chart);
  const worst = cell.points.first ?? 0;
  const start = () => {
    apply();
    if (rowsOf(table)) select(worst);
    view?.view([1, -1.2, 0.75]);
    return view?.drawn;
  };
  return { node, select, start };
}

export { behind };
