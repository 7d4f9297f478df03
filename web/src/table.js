// Tables of any length: a page of rows at a time, sorted and searched, walked with the arrow keys.
import { cell, csvButton, element, heading, rowsOf, slug, text } from "./data.js";

const PAGE = 50;
/** Rows on paper; of more it is said how many are missing. */
const PAPER = 500;
/** Texts longer than this are broken into lines. */
const LONG = 44;

/** Columns that say something: not those that are empty, nor the file where there is one. */
export function shownColumns(table) {
  const count = rowsOf(table);
  return table.columns.filter((column) => {
    if (column.hidden || column.detail) return false;
    if (column.label === "file" && column.values.names?.length === 1) return false;
    if (column.values.names) return count === 0 || column.values.names.some((name) => name !== "");
    return count === 0 || column.values.some((value) => value != null && value !== "");
  });
}

/** What stands behind the point of a number, the point too. */
const behindPoint = (shown) => shown.match(/^[^.]*(\..*)$/)?.[1] ?? "";

/** For each row of numbers what has to follow it, unseen, so that the points stand below one another. */
function padded(shown) {
  const long = shown.reduce((most, one) => (behindPoint(one).length > most.length ? behindPoint(one) : most), "");
  return shown.map((one) => {
    const own = behindPoint(one).length;
    return long.slice(own).replace(/[^.]/g, "0");
  });
}

/** Tables that are shown, to hear of paper. */
const shownTables = new Set();
const onPaper = (paper) => shownTables.forEach((hear) => hear(paper));
addEventListener("beforeprint", () => onPaper(true));
addEventListener("afterprint", () => onPaper(false));
matchMedia("print").addEventListener("change", (event) => onPaper(event.matches));

/**
 * Shows a table, its worst row first where a column says what is worst. `onselect(row)` makes its rows selectable; the result
 * has `select(row)` to select from outside.
 */
export function showTable(table, { title, onselect, page: rowsOfPage = PAGE } = {}) {
  let page = rowsOfPage;
  const count = rowsOf(table);
  const columns = shownColumns(table);
  let order = Array.from({ length: count }, (_, row) => row);
  let sorted = onselect ? null : columns.find((column) => column.worst) ?? null;
  let descending = sorted != null;
  let first = 0;
  let chosen = -1;
  const body = element("tbody");
  const where = element("span", { className: "where", "aria-live": "polite" });
  const back = element("button", { type: "button", onclick: () => turn(-1) }, "\u2039 Previous");
  const next = element("button", { type: "button", onclick: () => turn(1) }, "Next \u203a");

  /** Numbers stand to the right, also where some are missing. */
  const isNumeric = (column) => Array.isArray(column.values) && column.values.every((value) => value == null || typeof value === "number");
  const numeric = new Map(columns.map((column) => [column, count > 0 && isNumeric(column)]));

  const heads = columns.map((column) => {
    const button = element("button", { type: "button", className: "sort", onclick: () => sortBy(column) }, heading(column));
    return element("th", { scope: "col", className: numeric.get(column) ? "number" : "" }, button);
  });

  function turn(by) {
    first = Math.max(0, Math.min(first + by * page, Math.floor(Math.max(0, order.length - 1) / page) * page));
    fill();
  }

  function sortBy(column) {
    descending = sorted === column ? !descending : numeric.get(column);
    sorted = column;
    arrange();
  }

  function arrange() {
    const wanted = search.value.trim().toLowerCase();
    order = Array.from({ length: count }, (_, row) => row);
    if (wanted) {
      order = order.filter((row) => columns.some((column) => String(cell(column, row) ?? "").toLowerCase().includes(wanted)));
    }
    if (sorted) {
      const sign = descending ? -1 : 1;
      order.sort((a, b) => {
        const [x, y] = [cell(sorted, a), cell(sorted, b)];
        if (x == null || y == null) return (x == null) - (y == null);
        return sign * (typeof x === "number" ? x - y : String(x).localeCompare(String(y)));
      });
    }
    for (const [index, column] of columns.entries()) {
      const state = sorted === column ? (descending ? "descending" : "ascending") : null;
      if (state) heads[index].setAttribute("aria-sort", state);
      else heads[index].removeAttribute("aria-sort");
    }
    first = 0;
    fill();
  }

  function line(row, pads) {
    const cells = columns.map((column) => {
      const value = cell(column, row);
      const td = element("td", { className: numeric.get(column) ? "number" : "", "data-pad": pads.get(column)?.get(row) || null }, text(value, column));
      if (typeof value === "string" && value.length > LONG) td.classList.add("long");
      if (column.label === "severity" && value) td.classList.add("severity", String(value));
      return td;
    });
    const tr = element("tr", { "data-row": String(row) }, ...cells);
    if (onselect) {
      tr.setAttribute("aria-selected", String(row === chosen));
      tr.tabIndex = row === chosen || (chosen < 0 && row === order[first]) ? 0 : -1;
      tr.addEventListener("click", () => choose(row, true));
    }
    return tr;
  }

  function fill() {
    // the last page is a full one, too
    first = Math.max(0, Math.min(first, order.length - page));
    const shown = order.slice(first, first + page);
    const pads = new Map(columns.filter((column) => numeric.get(column)).map((column) => {
      const pad = padded(shown.map((row) => text(cell(column, row), column)));
      return [column, new Map(shown.map((row, k) => [row, pad[k]]))];
    }));
    body.replaceChildren(...shown.map((row) => line(row, pads)));
    if (onselect && shown.length && !body.querySelector('tr[tabindex="0"]')) body.firstElementChild.tabIndex = 0;
    const last = first + shown.length;
    where.textContent = order.length ? `${first + 1}\u2013${last} of ${order.length}` : "no rows";
    missing.textContent = shown.length < count ? `${count - shown.length} of ${count} rows are not on paper; "Save CSV" has all.` : "";
    back.disabled = first === 0;
    next.disabled = last >= order.length;
  }

  /** Selects a row: turns to its page, and moves the focus where a key asked for it. */
  function choose(row, report, focus = false) {
    chosen = row;
    let at = order.indexOf(row);
    if (at < 0) {
      search.value = "";
      arrange();
      at = order.indexOf(row);
    }
    if (at >= 0) first = Math.floor(at / page) * page;
    fill();
    const tr = body.querySelector(`tr[data-row="${row}"]`);
    if (tr && focus) tr.focus();
    // within its box only: the page stays where it is
    const box = grid.parentElement;
    if (tr && box) {
      const top = tr.offsetTop - box.offsetTop;
      if (top < box.scrollTop + tr.offsetHeight) box.scrollTop = top - tr.offsetHeight;
      else if (top + tr.offsetHeight > box.scrollTop + box.clientHeight) box.scrollTop = top + tr.offsetHeight - box.clientHeight;
    }
    if (report) onselect?.(row);
  }

  function walk(event) {
    const at = order.indexOf(Number(event.target.closest("tr")?.dataset.row ?? chosen));
    const steps = { ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page, Home: -Infinity, End: Infinity };
    if (event.key === "Enter" || event.key === " ") {
      event.preventDefault();
      choose(order[at], true, true);
    } else if (event.key in steps && order.length) {
      event.preventDefault();
      const to = Math.max(0, Math.min(order.length - 1, at + steps[event.key]));
      choose(order[to], true, true);
    }
  }

  const search = element("input", { type: "search", placeholder: "search", "aria-label": `Search ${title ?? "table"}`, oninput: arrange });
  const grid = element(
    "table",
    onselect ? { role: "grid", "aria-label": title, onkeydown: walk } : { "aria-label": title },
    element("thead", {}, element("tr", {}, ...heads)),
    body,
  );
  const many = count > page;
  const missing = element("p", { className: "missing-rows" });
  shownTables.add((paper) => {
    page = paper ? Math.max(PAPER, rowsOfPage) : rowsOfPage;
    fill();
  });
  const bar = element("div", { className: "bar" });
  if (count > 10) bar.append(search);
  if (many) bar.append(back, next);
  if (many || count > 10) bar.append(where);
  bar.append(csvButton(table, slug(title ?? "table")));
  arrange();
  const none = count ? null : element("p", { className: "where" }, "Nothing to list.");
  const node = element("div", { className: "table" }, element("div", { className: "rows" }, grid), none, missing, bar);
  return { node, select: (row) => choose(row, false) };
}

/** The table behind a chart, made when it is opened. */
export function behind(table, title) {
  const details = element("details", { className: "behind" }, element("summary", {}, "Table"));
  details.addEventListener("toggle", () => {
    if (details.open && details.children.length === 1) details.append(showTable(table(), { title }).node);
  });
  return details;
}
