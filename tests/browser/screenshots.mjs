// The pictures of the documents. REPORTS names the folder that reports.sh filled; the argument is where they go.
import { join } from "node:path";
import { launch, open } from "./browser.mjs";

const out = process.argv[2];
const width = 1180;
/** From the top of one element to the end of another. */
const pictures = [
  { kind: "check", name: "report-check", from: 'section h2:text("In the cell")', to: ".scale" },
  { kind: "diagnose", name: "report-diagnose", from: 'section h2:text("What was found")', to: ".charts .chart:last-child .plot" },
];
const browser = await launch();
for (const { kind, name, from, to } of pictures) {
  const { page, context, wrong } = await open(browser, join(process.env.REPORTS, `${kind}.html`), { width });
  if (wrong.length) throw new Error(wrong.join("\n"));
  // charts are drawn when they are seen
  for (const box of await page.locator(".plot").all()) {
    await box.scrollIntoViewIfNeeded();
    await box.locator("svg").first().waitFor();
  }
  await page.evaluate(() => scrollTo(0, 0));
  await page.waitForTimeout(400);
  const [top, end] = [await page.locator(from).first().boundingBox(), await page.locator(to).first().boundingBox()];
  const y = Math.max(0, top.y - 12);
  await page.screenshot({ path: join(out, `${name}.png`), fullPage: true, clip: { x: 0, y, width, height: end.y + end.height + 12 - y } });
  await context.close();
}
await browser.close();
