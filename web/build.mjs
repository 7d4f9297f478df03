// Builds src/report/html/assets/report.js and report.css, which the program embeds. `node build.mjs DIR` writes there instead.
import { build } from "esbuild";
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2] ?? join(here, "..", "src", "report", "html", "assets");

// every package whose code is in the bundle, with its licence
function bundled(metafile) {
  const names = new Set();
  const inputs = Object.values(metafile.outputs).flatMap((output) => Object.entries(output.inputs));
  for (const [path, { bytesInOutput }] of inputs) {
    if (bytesInOutput === 0) continue;
    const found = path.match(/node_modules\/((?:@[^/]+\/)?[^/]+)\//);
    if (found) names.add(found[1]);
  }
  return [...names].sort().map((name) => {
    const about = JSON.parse(readFileSync(join(here, "node_modules", name, "package.json"), "utf8"));
    return `${name} ${about.version} (${about.license})`;
  });
}

const options = {
  absWorkingDir: here,
  entryPoints: { report: "src/main.js" },
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  charset: "ascii",
  legalComments: "none",
  logLevel: "warning",
};
const { metafile } = await build({ ...options, write: false, metafile: true, outdir: out });
const packages = bundled(metafile);
const banner = `/* poseshift report. Bundled libraries, each under the licence named; texts in docs/reports.md: ${packages.join(", ")} */`;
await build({ ...options, outdir: out, banner: { js: banner } });
await build({ ...options, entryPoints: { report: "src/style.css" }, outdir: out });
