// How pages look: in two widths, in light and dark, on paper, and with keys alone.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { sheets } from "./paper.mjs";
import { chartsOf, inside, json, kinds, number, rowsOf } from "./pages.mjs";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const WIDTHS = [1400, 800];
const HEIGHT = 900;

/** The largest by a size. */
const largest = (list, size) => list.reduce((most, one) => ((size(one) ?? -Infinity) > (size(most) ?? -Infinity) ? one : most));
/** The first error among findings, else the first warning. */
const gravest = (findings) => findings.find((one) => one.severity === "error") ?? findings.find((one) => one.severity === "warning");

/** Bounds are rounded outwards. */
const upwards = (mm) => (Math.ceil(mm * 1e3 - 1e-6) / 1e3).toFixed(3);
const downwards = (mm) => (Math.floor(mm * 1e2 + 1e-6) / 1e2).toFixed(2);

/** What each page has to say first, of its JSON: texts that stand in what is seen without scrolling. */
const worst = {
  compensate: (of) => [of.summary.max_before_mm.toFixed(3), gravest(of.findings)?.id],
  krl: (of) => [of.summary.max_before_mm.toFixed(3), gravest(of.findings)?.id],
  many: () => ["largest error"],
  evil: (of) => [gravest(of.findings)?.id],
  empty: (of) => [gravest(of.findings)?.id ?? "0 of 0"],
  check: (of) => [upwards(of.summary.max_path_error_mm), downwards(of.summary.min_clearance_mm)],
  collision: (of) => [gravest(of.findings).id, gravest(of.findings).message.slice(0, 40), upwards(of.summary.max_path_error_mm)],
  rail: (of) => [gravest(of.findings)?.id, upwards(of.summary.max_path_error_mm)],
  positioner: (of) => [gravest(of.findings)?.id, upwards(of.summary.max_path_error_mm)],
  calibrate: (of) => [of.after.position.max_mm.toFixed(4)],
  validate: (of) => [of.position.real.max_mm.toFixed(4), of.position.controller.max_mm.toFixed(4)],
  diagnose: (of) => [of.left_mm.toFixed(4), ...of.effects.filter((one) => one.standing !== "certain").slice(0, 1).map((one) => one.effect)],
  plan: (of) => (of.not_determined.length ? [of.not_determined[0].key] : [String(of.joints_deg.length)]),
  register: (of) => { const one = largest(of.points, (p) => p.distance_mm); return [one.distance_mm.toFixed(4), one.id]; },
  icp: (of) => [of.icp.rms_mm.toFixed(4)],
  taught: (of) => [Math.max(...of.residuals_mm.map((r) => Math.hypot(...r))).toFixed(4)],
  handeye: (of) => [Math.max(...of.poses.map((one) => one.residual_mm)).toFixed(4)],
  hexapod: (of) => [Math.max(...of.poses.map((one) => one.largest_sigma_mm)).toFixed(5)],
  reach: (of) => [`${of.measurable} of ${of.reach.length}`],
  axes: (of) => { const one = largest(of.joints, (j) => j.tangential_deg); return [one.tangential_deg.toFixed(4), `joint ${one.joint}`]; },
};

test("every page has something that it says first", () => assert.deepEqual(kinds.filter((kind) => !worst[kind]), []));

/** All text that is seen in the window as it opens. */
const seen = (page) => page.evaluate(() => {
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const texts = [];
  while (walker.nextNode()) {
    const range = document.createRange();
    range.selectNodeContents(walker.currentNode);
    const box = range.getBoundingClientRect();
    if (box.width > 0 && box.top >= 0 && box.bottom <= window.innerHeight && box.right <= window.innerWidth + 1) texts.push(walker.currentNode.textContent);
  }
  return texts.join(" \u00b6 ");
});

/** What is wider than the window: elements, but for those that scroll by themselves. */
const tooWide = (page) => page.evaluate(() => {
  const scrolls = (node) => node && node !== document.body && (["auto", "scroll", "hidden"].includes(getComputedStyle(node).overflowX) || scrolls(node.parentElement));
  const over = [...document.body.querySelectorAll("*")].filter((node) => node.getBoundingClientRect().right > window.innerWidth + 1 && !scrolls(node.parentElement));
  const page = document.documentElement.scrollWidth - window.innerWidth;
  return [...over.slice(0, 3).map((node) => `${node.localName}.${node.getAttribute("class") ?? ""}`), ...(page > 1 ? [`${page} pixels`] : [])];
});

for (const kind of kinds) {
  for (const width of WIDTHS) {
    for (const dark of [false, true]) {
      test(`${kind}, ${width} pixels, ${dark ? "dark" : "light"}: nothing is too wide, no rule of axe is broken, the worst stands first`, async () => {
        await inside(kind, { width, height: HEIGHT, dark }, async (page) => {
          const first = await seen(page);
          const of = kind === "many" ? null : json(kind);
          for (const text of worst[kind](of).filter((one) => one != null)) assert.ok(first.includes(text), `"${text}" is not seen without scrolling:\n${first}`);
          await chartsOf(page);
          assert.deepEqual(await tooWide(page), []);
          // the page's policy lets no script in: axe runs outside of it
          await page.evaluate(() => window.scrollTo(0, 0));
          await page.evaluate(axe);
          const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
          assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map((node) => `${node.html.slice(0, 160)} ${node.any[0]?.message ?? ""}`).join(" | ")}`), []);
        });
      });
    }
  }

  test(`${kind} on paper: every row or how many are missing, the foot on the last sheet`, async () => {
    await inside(kind, {}, async (page) => {
      const pdf = await page.pdf();
      const last = sheets(pdf).at(-1);
      assert.ok(last.texts > 0, `the last of ${last.number} sheets is empty`);
      await page.emulateMedia({ media: "print" });
      const tables = await page.locator(".table").evaluateAll((list) => list.filter((one) => one.checkVisibility()).map((one) => ({
        label: one.querySelector("table").getAttribute("aria-label"),
        shown: one.querySelectorAll("tbody tr").length,
        where: one.querySelector(".where")?.textContent ?? "",
        missing: one.querySelector(".missing-rows").textContent,
        seen: one.querySelector(".missing-rows").checkVisibility(),
      })));
      for (const { label, shown, where, missing, seen: isSeen } of tables) {
        const all = Number(where.match(/of (\d+)$/)?.[1] ?? shown);
        if (shown === all) assert.equal(missing, "", label);
        else assert.ok(isSeen && missing.startsWith(`${all - shown} of ${all} rows `), `${label}: ${shown} of ${all}, ${missing}`);
      }
    });
  });
}

test("points in charts are chosen by keys", async () => {
  await inside("check", {}, async (page) => {
    const moves = json("check").moves;
    await chartsOf(page);
    const plot = page.getByRole("slider", { name: "Error of each move: arrow keys choose a point" });
    await plot.focus();
    await page.keyboard.press("Home");
    const line = () => page.locator(".detail .lineno").textContent().then(Number);
    assert.equal(await line(), moves[0].line);
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("ArrowRight");
    assert.equal(await line(), moves[2].line);
    assert.match(await plot.getAttribute("aria-valuetext"), new RegExp(`^move 3, line ${moves[2].line}, `));
    assert.ok((await plot.locator("circle.chosen").count()) > 0, "no ring");
    await page.keyboard.press("End");
    assert.equal(await line(), moves.at(-1).line);
    // the other charts ring it, too
    assert.ok((await page.locator(".plot circle.chosen").count()) > 2);
  });
});

test("points coloured by error have a scale next to them", async () => {
  for (const kind of ["calibrate", "validate", "diagnose", "register", "icp", "handeye", "check", "compensate"]) {
    await inside(kind, {}, async (page) => {
      const scale = page.locator(".space .scale").first();
      assert.match(await scale.textContent(), /^(points|poses|moves' ends|targets): [a-z ]+0[0-9.]+ mm$/, kind);
      assert.match(await scale.locator("i").getAttribute("style"), /linear-gradient/);
    });
  }
});

test("before and after share an axis", async () => {
  for (const [kind, models] of [["calibrate", ["before", "frames only", "after"]], ["validate", ["controller", "frames only", "real"]]]) {
    await inside(kind, {}, async (page) => {
      const chart = page.locator("figure.chart", { has: page.getByRole("heading", { name: "Errors", exact: true }) });
      await chart.scrollIntoViewIfNeeded();
      await chart.locator("svg[role=img]").waitFor();
      assert.deepEqual(await chart.locator(".legend li").allTextContents(), models);
      // every row counts once for each model
      await chart.locator("summary").click();
      const rows = await rowsOf(page, "Errors");
      const total = (name) => rows.reduce((sum, row) => sum + number(row[name]), 0);
      const counts = models.map(total);
      assert.ok(counts[0] > 10 && counts.every((count) => count === counts[0]), counts.join());
    });
  }
});

test("numbers of a column have their points below one another", async () => {
  await inside("calibrate", { width: 1400 }, async (page) => {
    const places = await page.locator('table[aria-label="Parameters"] tbody tr').evaluateAll((rows) => rows.map((row) => {
      const cell = row.children[1];
      const at = cell.textContent.indexOf(".");
      if (at < 0) return null;
      const range = document.createRange();
      range.setStart(cell.firstChild, at);
      range.setEnd(cell.firstChild, at + 1);
      return range.getBoundingClientRect().left;
    }).filter((x) => x != null));
    assert.ok(places.length > 5);
    // a minus of an exponent is not as wide as a digit
    assert.ok(Math.max(...places) - Math.min(...places) < 3, places.join());
  });
});

test("a table without an order of its own opens at its worst row", async () => {
  for (const [kind, label, column] of [["axes", "Joints", "tangential, rms, deg"], ["register", "Uncertainty, one standard deviation", "longest half axis, mm"]]) {
    await inside(kind, {}, async (page) => {
      const sizes = (await rowsOf(page, label)).map((row) => number(row[column]));
      assert.ok(sizes.length > 1);
      assert.deepEqual(sizes, sizes.toSorted((a, b) => b - a), `${kind}: ${label}`);
    });
  }
});

test("a page ends with its version, date and command line", async () => {
  for (const kind of kinds) {
    await inside(kind, {}, async (page) => {
      assert.match(await page.locator("footer p").first().textContent(), /^poseshift \d+\.\d+\.\d+, \d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ: poseshift [a-z]+ /);
    });
  }
});
