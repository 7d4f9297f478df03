// The pages that reports.sh made (REPORTS names its folder), and how a test looks at one.
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { after, before } from "node:test";
import { launch, open } from "./browser.mjs";

const folder = process.env.REPORTS;
export const kinds = readdirSync(folder).filter((name) => name.endsWith(".html")).map((name) => name.slice(0, -5));
export const file = (kind) => join(folder, `${kind}.html`);
export const json = (kind) => JSON.parse(readFileSync(join(folder, `${kind}.json`), "utf8"));

/** The browser of a file of tests. */
export const shared = {};
before(async () => {
  shared.browser = await launch();
});
after(() => shared.browser?.close());

/** Opens, hands over, and looks afterwards whether anything went wrong. */
export async function inside(kind, options, look) {
  const opened = await open(shared.browser, file(kind), options);
  try {
    await look(opened.page, opened);
    assert.deepEqual(opened.wrong, []);
  } finally {
    await opened.context.close();
  }
}

/** A table on the page as objects by heading; the first page of it. */
export const rowsOf = (page, label) => page.locator(`table[aria-label="${label}"]`).evaluate((table) => {
  const heads = [...table.querySelectorAll("thead th")].map((th) => th.textContent);
  return [...table.querySelectorAll("tbody tr")].map((tr) => Object.fromEntries([...tr.children].map((td, k) => [heads[k], td.textContent])));
});

/** Every chart of the page, drawn because it was scrolled to. */
export async function chartsOf(page) {
  for (const box of await page.locator(".plot").all()) {
    await box.scrollIntoViewIfNeeded();
    await box.locator("svg[role=img]").waitFor({ timeout: 5000 });
  }
  return page.locator(".plot svg[role=img]").all();
}

/** A number as pages write it. */
export const number = (text) => Number(text.replaceAll("\u2212", "-"));
