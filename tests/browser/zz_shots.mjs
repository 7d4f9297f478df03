import { launch, open } from "./browser.mjs";
import { readdirSync } from "node:fs";
const [,, dir, out, mode, ...only] = process.argv;
const b = await launch();
for (const f of readdirSync(dir).filter(n=>n.endsWith(".html")&&(!only.length||only.includes(n.slice(0,-5))))) {
  const k=f.slice(0,-5);
  const { page, context, wrong } = await open(b, `${dir}/${f}`, { dark: mode==="dark", width: mode==="narrow"?800:1280, height: 900 });
  for (const box of await page.locator(".plot").all()) { await box.scrollIntoViewIfNeeded(); await box.locator("svg").first().waitFor(); }
  await page.evaluate(()=>scrollTo(0,0)); await page.waitForTimeout(500);
  if (mode==="pdf") await page.pdf({ path: `${out}/${k}.pdf`, format: "A4", printBackground: true });
  else await page.screenshot({ path: `${out}/${k}-${mode}.png`, fullPage: true });
  console.log(k, wrong.join()); await context.close();
}
await b.close();
