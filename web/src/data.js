// What the page's JSON holds, and how numbers are shown.

/** The page's data: JSON, or much of it packed (zlib, base64). */
export async function dataOf(node) {
  if (node.type !== "application/zlib") return JSON.parse(node.textContent);
  const letters = atob(node.textContent);
  const packed = new Uint8Array(letters.length);
  for (let k = 0; k < packed.length; k += 1) packed[k] = letters.charCodeAt(k);
  const unpacked = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(unpacked).json();
}

/** The value of a cell: columns are arrays, or names with indices where few names repeat. */
export function cell(column, row) {
  const values = column.values;
  if (Array.isArray(values)) return values[row];
  const index = values.index[row];
  return index == null ? null : values.names[index];
}

/** Rows of a table. */
export function rowsOf(table) {
  const first = table.columns[0];
  if (!first) return 0;
  return Array.isArray(first.values) ? first.values.length : first.values.index.length;
}

/** A column's heading with its unit. */
export function heading(column) {
  return column.unit ? `${column.label}, ${column.unit}` : column.label;
}

/** A number as text, with a column's decimals where it has some: a value that is none is a dash, one below what it can say is said to be so. */
export function text(value, { decimals, least } = {}) {
  if (value == null) return "\u2013";
  if (least != null && value < least) return `< ${least}`;
  if (typeof value === "boolean") return value ? "yes" : "no";
  if (typeof value !== "number") return String(value);
  if (decimals != null && Math.abs(value) < 1e7) return value.toFixed(decimals).replace(/^-(?=0\.?0*$)/, "").replace("-", "\u2212");
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e7 || size < 1e-4) return value.toExponential().replace("-", "\u2212").replace("-", "\u2212");
  return String(value).replace("-", "\u2212");
}

/** A table as CSV, all rows. */
export function csv(table) {
  const quoted = (value) => {
    if (value == null) return "";
    const raw = String(value);
    // a text that a spreadsheet would take for a formula stays a text
    const safe = typeof value === "string" && /^[=+\-@\t\r]/.test(raw) ? `'${raw}` : raw;
    return /[",\n\r]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
  };
  const lines = [table.columns.map((column) => quoted(heading(column))).join(",")];
  const count = rowsOf(table);
  for (let row = 0; row < count; row += 1) {
    lines.push(table.columns.map((column) => quoted(cell(column, row))).join(","));
  }
  return `${lines.join("\r\n")}\r\n`;
}

/** Makes an element with properties and children; children that are text are text, never markup. */
export function element(name, properties = {}, ...children) {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(properties)) {
    if (value == null || value === false) continue;
    if (key.startsWith("on")) node.addEventListener(key.slice(2), value);
    else if (key in node && key !== "list" && !key.startsWith("aria")) node[key] = value;
    else node.setAttribute(key, value === true ? "" : value);
  }
  node.append(...children.filter((child) => child != null));
  return node;
}

/** A button that saves a table as a CSV file. */
export function csvButton(table, name) {
  const save = () => {
    const blob = new Blob([csv(table)], { type: "text/csv;charset=utf-8" });
    const link = element("a", { href: URL.createObjectURL(blob), download: `${name}.csv` });
    document.body.append(link);
    link.click();
    link.remove();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  };
  return element("button", { type: "button", className: "save", onclick: save }, "Save CSV");
}

/** A file name of a title. */
export function slug(title) {
  return title.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "") || "table";
}
