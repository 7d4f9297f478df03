// Builds the page of its JSON.
import { cell as valueOf, dataOf, element, rowsOf } from "./data.js";
import { showCell } from "./cell.js";
import { showChart, showHeat } from "./charts.js";
import { showTable } from "./table.js";

/** Findings of the page's table of findings that stand at a line of a file. */
function findingsAt(findings) {
  if (!findings) return () => [];
  const column = (label) => findings.columns.find((one) => one.label === label);
  const [severity, id, file, line, message] = ["severity", "id", "file", "line", "message"].map(column);
  const at = new Map();
  for (let row = 0; row < rowsOf(findings); row += 1) {
    const place = `${valueOf(line, row)} ${valueOf(file, row)}`;
    if (!at.has(place)) at.set(place, []);
    at.get(place).push({ severity: valueOf(severity, row), id: valueOf(id, row), message: valueOf(message, row) });
  }
  return (fileName, lineNumber) => at.get(`${lineNumber} ${fileName}`) ?? [];
}

async function main() {
  const place = document.getElementById("page");
  const page = await dataOf(document.getElementById("data"));
  const tables = page.tables ?? {};
  const found = findingsAt(tables.findings);
  const starts = [];
  let choose = null;
  // charts whose points are items of the view
  const linked = [];
  let charts = null;
  for (const section of page.sections) {
    if (section.type !== "chart") charts = null;
    switch (section.type) {
      case "cell": {
        const table = tables[section.table];
        const [file, line] = ["file", "line"].map((label) => table.columns.find((column) => column.label === label));
        const shown = showCell(section, table, (row) => (line ? found(file ? valueOf(file, row) : "", valueOf(line, row)) : []), (row) => linked.forEach((chart) => chart.mark(row)));
        choose = shown.select;
        starts.push(shown.start);
        place.append(shown.node);
        break;
      }
      case "chart": {
        if (!charts) {
          charts = element("section", { className: "charts" });
          place.append(charts);
        }
        const table = tables[section.table];
        const pick = section.picks ? (row) => choose?.(row) : null;
        const chart = showChart(section, table, pick);
        if (pick) linked.push(chart);
        charts.append(chart);
        break;
      }
      case "heat":
        place.append(element("section", {}, showHeat(section)));
        break;
      case "table": {
        const shown = showTable(tables[section.table], { title: section.title });
        const note = section.note ? element("p", {}, section.note) : null;
        place.append(element("section", {}, element("h2", {}, section.title), note, shown.node));
        break;
      }
      default:
        place.append(element("section", {}, element("h2", {}, section.title), ...section.lines.map((line) => element("p", {}, line))));
    }
  }
  // views are drawn, and charts that are seen: those with the next frame, when their width is known
  await Promise.all(starts.map((start) => start()));
  requestAnimationFrame(() => requestAnimationFrame(() => {
    document.documentElement.dataset.ready = "yes";
  }));
}

main().catch((error) => {
  const words = "This browser cannot show the views, charts and long tables of this report; the numbers above are complete.";
  document.getElementById("page").append(element("p", { className: "missing" }, words));
  throw error;
});
