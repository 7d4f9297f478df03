// The view in space of programs with a rail and with a positioner: what the page's script makes of the page's data is compared with the
// numbers of the program, which are the poses of the tool in the frame the program names.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { dataOf } from "../../web/src/data.js";
import { difference } from "./pixels.mjs";
import { file, inside, number, shared } from "./pages.mjs";

const programs = join(dirname(fileURLToPath(import.meta.url)), "..", "..", "programs");
const robotOf = await import("../../web/src/robot.js").catch(() => null);
const skip = robotOf ? false : "three is not installed in web";

/** The view in space of a page, and its robot. */
async function viewOf(kind) {
  const [, type, text] = readFileSync(file(kind), "utf8").match(/<script type="([^"]+)" id="data">([^<]*)</);
  const page = await dataOf({ type, textContent: text });
  const cell = page.sections.find((section) => section.type === "cell");
  return { points: cell.points, robot: robotOf.makeRobot(cell.robot) };
}

/** Poses the robot as a choice of that row does. */
function choose({ points, robot }, row) {
  const axes = points.external.length / (points.at.length / 3);
  const external = points.external.slice(axes * row, axes * (row + 1));
  robot.pose(points.joints.slice(6 * row, 6 * row + 6), points.tool?.[row] ?? 0, external);
  return external;
}

/** Joints are drawn to a hundredth of a degree: so much at the reach of these arms, and a move is a hundred times longer. */
const DRAWN_MM = 0.5;
/** Columns of numbers in a text, one array a match. */
const numbers = (text, pattern) => [...text.matchAll(pattern)].map((match) => match.slice(1).map(Number));
const apart = (a, b) => Math.hypot(...a.map((x, k) => x - b[k]));

test("the rail carries the base to the value of the move, and the tool to the pose of the program", { skip }, async () => {
  const text = readFileSync(join(programs, "rapid/rail/in/Beam.mod"), "latin1");
  const moves = numbers(text, /Move[JL] \[\[([-.\d]+),([-.\d]+),([-.\d]+)\].*?,\[([-.\d]+),9E9/g);
  const view = await viewOf("rail");
  const rows = view.points.at.length / 3;
  assert.ok(moves.length >= 25 && rows >= moves.length, `${moves.length} of ${rows}`);
  const [tool, base] = ["tool", "base"].map((name) => view.robot.group.getObjectByName(name));
  const bases = [];
  for (const [k, [x, y, z, e]] of moves.entries()) {
    const row = rows - moves.length + k;
    assert.deepEqual(choose(view, row), [e]);
    const off = apart(tool.matrix.elements.slice(12, 15), [x, y, z]);
    assert.ok(off < DRAWN_MM, `row ${row}: the tool is drawn ${off} mm from its target`);
    bases.push(base.matrix.elements.slice(12, 15));
  }
  // from 150 to 2 790 mm along x, and nowhere else
  const first = moves[0][3];
  for (const [k, at] of bases.entries()) assert.ok(apart(at, [bases[0][0] + moves[k][3] - first, bases[0][1], bases[0][2]]) < 1e-6, `${at}`);
});

test("the plate is drawn as it stands at the move: the tool is at the pose of the program on it", { skip }, async () => {
  const text = readFileSync(join(programs, "krl/positioner/in/pipe.src"), "latin1");
  const moves = numbers(text, /(?:PTP|LIN) \{X ([-.\d]+),Y ([-.\d]+),Z ([-.\d]+),.*?E1 ([-.\d]+)\}/g);
  const view = await viewOf("positioner");
  const rows = view.points.at.length / 3;
  assert.ok(moves.length >= 20 && rows >= moves.length, `${moves.length} of ${rows}`);
  const [tool, plate] = ["tool", "plate of 2"].map((name) => view.robot.group.getObjectByName(name));
  for (const [k, [x, y, z, e]] of moves.entries()) {
    const row = rows - moves.length + k;
    assert.deepEqual(choose(view, row), [e]);
    assert.ok(plate.visible);
    const there = tool.position.clone().setFromMatrixPosition(tool.matrix).applyMatrix4(plate.matrix.clone().invert());
    const off = apart(there.toArray(), [x, y, z]);
    assert.ok(off < DRAWN_MM, `row ${row}: the tool is drawn ${off} mm from its target on the plate`);
  }
  // where nobody knows how it stands there is no plate
  view.robot.pose([0, 0, 0, 0, 0, 0], 0, [null]);
  assert.ok(!plate.visible);
});

for (const kind of ["rail", "positioner"]) {
  test(`${kind}: another move is drawn with its external axis, which the list of the move says`, async () => {
    await inside(kind, {}, async (page) => {
      const row = (k) => page.locator('table[aria-label="Moves"] tbody tr').nth(k);
      const canvas = page.locator(".stage canvas");
      const seen = [];
      for (const k of [3, 12]) {
        await row(k).click();
        await page.waitForFunction(() => [...document.querySelectorAll(".stage canvas")].every((one) => one.dataset.drawn === "full"));
        const names = await page.locator(".detail dt").allTextContents();
        const value = (await page.locator(".detail dd").allTextContents())[names.indexOf("external axes, mm or deg")];
        const line = Number(await page.locator(".detail .lineno").textContent());
        const source = readFileSync(join(programs, kind === "rail" ? "rapid/rail/in/Beam.mod" : "krl/positioner/in/pipe.src"), "latin1").split(/\r?\n/)[line - 1];
        const written = source.match(kind === "rail" ? /\[([-.\d]+),9E9/ : /E1 ([-.\d]+)/)[1];
        assert.equal(number(value), Number(written), `line ${line}`);
        seen.push(await canvas.screenshot());
      }
      assert.ok((await difference(shared.browser, ...seen)) > 0.005, "the view does not change");
    });
  });
}
