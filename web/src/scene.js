// The view in space: robot, bodies, points that can be chosen, paths and vectors whose deviations are magnified.
import { interpolateTurbo } from "d3-scale-chromatic";
import { Box3, BufferAttribute, BufferGeometry, Color, ColorManagement, Group, LinearSRGBColorSpace, Matrix4, Mesh, PerspectiveCamera, Points, Scene, SphereGeometry, Vector2, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { dots, lines, paths, solid } from "./paint.js";
import { bodyOf, makeRobot } from "./robot.js";

// colours are those of the page, as they are
ColorManagement.enabled = false;

/** Error 0 to 1 as a colour; the ends of the ramp, too dark on both grounds, are left out. */
export const ramp = (part) => interpolateTurbo(0.1 + 0.8 * Math.max(0, Math.min(1, part)));

const SHADES = 256;
let shades = null;

/** The ramp's colour as three numbers. */
function shade(part) {
  shades ??= Array.from({ length: SHADES }, (_, k) => new Color(ramp(k / (SHADES - 1))).toArray());
  return shades[Math.round((SHADES - 1) * Math.max(0, Math.min(1, part)))];
}

const css = (name) => new Color(getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim() || "#888");

/** Lines of a path and dots that are drawn while the view turns. */
const WHILE_TURNING = 2500;
/** So long after the last move the view is drawn in full, milliseconds. */
const REST = 160;
/** Pixels drawn for one of the page, across: at rest, and while the view turns, by how fast this machine draws. */
const FINENESS = { rest: 2, turning: [1, 0.75, 0.5, 0.4] };
/** A frame that takes longer than this, milliseconds, is too slow. */
const SLOW = 34;

/** Lines through the samples of a path, each shifted by its deviation times a magnification. */
class Path {
  constructor(path, worst) {
    this.path = path;
    const { at, by, error, graded, starts } = path;
    const base = css(path.tone);
    const tintOf = (k) => (by && graded ? shade(error[k] / worst) : base.toArray());
    const { wide, narrow, place } = paths(at.length / 3, starts ?? [], (k) => tintOf(k).map((part) => 255 * part), WHILE_TURNING);
    Object.assign(this, { wide, narrow, place, width: by ? 2.6 : 1.6 });
    this.lines = new Group();
    this.lines.add(wide, narrow);
    this.shift(by ? 1 : 0);
  }

  shift(times) {
    const { at, by } = this.path;
    this.place(by ? (k, axis) => at[3 * k + axis] + times * by[3 * k + axis] : (k, axis) => at[3 * k + axis]);
  }

  fineness(coarse, screen, ratio) {
    this.wide.visible = !coarse;
    this.narrow.visible = coarse;
    this.wide.material.uniforms.screen.value.copy(screen);
    this.wide.material.uniforms.width.value = this.width * ratio;
  }
}

/** Shows a cell. Throws where the browser has no WebGL. */
export class View {
  constructor(box, cell, onpick) {
    this.cell = cell;
    this.renderer = new WebGLRenderer({ antialias: false, alpha: true, stencil: false, preserveDrawingBuffer: true });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.debug.checkShaderErrors = false;
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", `${cell.title}: arrow keys rotate, plus and minus come nearer and go away`);
    box.append(this.canvas);
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(38, 1, 1, 1e5);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.byHand = false;
    this.controls.addEventListener("start", () => { this.byHand = true; });
    this.controls.addEventListener("end", () => { this.byHand = false; });
    this.controls.addEventListener("change", () => (this.byHand ? this.turn() : this.draw()));
    this.layers = { paths: [] };
    this.magnification = 1;
    this.turning = false;
    // without a graphics card every pixel costs
    this.level = /swiftshader|llvmpipe|software|basic render/i.test(this.nameOfCard()) ? 2 : 0;
    this.build();
    this.view([1, -1.2, 0.75]);
    this.listen(onpick);
    new ResizeObserver(() => this.resize(box)).observe(box);
    this.resize(box);
    // shaders are compiled while the rest of the page is made
    this.drawn = new Promise((done) => { this.tellDrawn = done; });
    const isParallel = this.renderer.getContext().getExtension("KHR_parallel_shader_compile");
    (isParallel ? this.renderer.compileAsync(this.scene, this.camera) : Promise.resolve()).then(() => {
      this.compiled = true;
      this.draw();
    });
  }

  nameOfCard() {
    const gl = this.renderer.getContext();
    const about = gl.getExtension("WEBGL_debug_renderer_info");
    return String(gl.getParameter(about ? about.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  }

  build() {
    const { cell } = this;
    this.bounds = new Box3();
    const see = (flat) => {
      const point = new Vector3();
      for (let k = 0; k + 2 < flat.length; k += 3) this.bounds.expandByPoint(point.fromArray(flat, k));
    };
    for (const path of cell.paths) see(path.at);
    see(cell.points.at.filter((x) => x != null));
    for (const { at } of cell.ellipsoids ?? []) see(at);
    this.extent = this.bounds.isEmpty() ? 500 : Math.max(50, this.bounds.getSize(new Vector3()).length());
    this.solids = new Group();
    this.scene.add(this.solids);
    if (cell.robot) {
      this.robot = makeRobot(cell.robot);
      this.scene.add(this.robot.group);
      const base = new Vector3().setFromMatrixPosition(new Matrix4().fromArray(cell.robot.base));
      this.bounds.expandByPoint(base);
    }
    this.ground();
    for (const body of cell.bodies) this.solids.add(bodyOf(body, 0x7d8fa8, body.form === "plane" ? 0.15 : 0.35));
    this.worst = Math.max(1e-12, ...cell.paths.map((path) => path.worst ?? 0));
    for (const path of cell.paths) {
      const shown = new Path(path, this.worst);
      this.layers.paths.push(shown);
      this.scene.add(shown.lines);
    }
    this.placeItems();
    this.placeEllipsoids();
  }

  /** A grid to tell up from down: through the robot's base, else below everything. */
  ground() {
    const reach = (this.cell.robot?.rows ?? []).reduce((sum, row) => sum + Math.abs(row[1]) + Math.abs(row[4]), 0);
    const size = 200 * 2 ** Math.ceil(Math.log2(Math.max(1, this.extent, reach) / 100));
    const corners = [];
    for (let k = 0; k <= 16; k += 1) {
      const [at, end] = [size * (k / 16 - 0.5), size / 2];
      corners.push(-end, at, 0, end, at, 0, at, -end, 0, at, end, 0);
    }
    const grid = lines(corners, corners.map(() => 0.53), { opacity: 0.3 });
    if (!this.cell.robot && !this.bounds.isEmpty()) {
      const middle = this.bounds.getCenter(new Vector3());
      grid.position.set(middle.x, middle.y, this.bounds.min.z - 0.05 * this.extent);
    }
    this.scene.add(grid);
  }

  /** A dot at each item, and a ball that marks the chosen. */
  placeItems() {
    const { at } = this.cell.points;
    const count = at.length / 3;
    this.rows = [];
    for (let row = 0; row < count; row += 1) if (at[3 * row] != null) this.rows.push(row);
    const geometry = new BufferGeometry();
    const [places, colours] = [new Float32Array(3 * this.rows.length), new Float32Array(3 * this.rows.length)];
    const plain = css("wanted").toArray();
    const { error } = this.cell.points;
    this.most = (error ?? []).reduce((top, x) => Math.max(top, x ?? 0), 0);
    const most = Math.max(this.most, 1e-12);
    this.rows.forEach((row, n) => {
      places.set(at.slice(3 * row, 3 * row + 3), 3 * n);
      colours.set(error?.[row] == null ? plain : shade(error[row] / most), 3 * n);
    });
    geometry.setAttribute("position", new BufferAttribute(places, 3));
    geometry.setAttribute("tint", new BufferAttribute(colours, 3));
    this.dotSize = count > 2000 ? 3 : 5.5;
    const every = Math.max(1, Math.ceil(this.rows.length / WHILE_TURNING));
    const some = (step) => new BufferAttribute(Uint32Array.from({ length: Math.ceil(this.rows.length / step) }, (_, k) => k * step), 1);
    this.allItems = some(1);
    this.fewItems = every > 1 ? some(every) : this.allItems;
    geometry.setIndex(this.allItems);
    this.items = new Points(geometry, dots());
    this.items.frustumCulled = false;
    this.scene.add(this.items);
    this.mark = new Mesh(new SphereGeometry(1, 20, 14), solid(new Color(0xe6007e), { opacity: 0.9, onTop: true, flat: true }));
    this.mark.renderOrder = 4;
    this.mark.visible = false;
    this.scene.add(this.mark);
  }

  placeEllipsoids() {
    this.ellipsoids = [];
    const material = solid(css("after"), { opacity: 0.45 });
    for (const { at, axes } of this.cell.ellipsoids ?? []) {
      const mesh = new Mesh(new SphereGeometry(1, 24, 16), material);
      mesh.matrixAutoUpdate = false;
      this.scene.add(mesh);
      this.ellipsoids.push({ mesh, at, axes });
    }
  }

  magnify(times, byHand = false) {
    this.magnification = times;
    for (const path of this.layers.paths) if (path.path.by) path.shift(times);
    for (const { mesh, at, axes } of this.ellipsoids) {
      const [u, v, w] = [0, 3, 6].map((k) => axes.slice(k, k + 3).map((x) => x * times));
      mesh.matrix.set(u[0], v[0], w[0], at[0], u[1], v[1], w[1], at[1], u[2], v[2], w[2], at[2], 0, 0, 0, 1);
      mesh.matrixWorldNeedsUpdate = true;
    }
    if (byHand) this.turn();
    else this.draw();
  }

  select(row) {
    const { at, joints, tool, external } = this.cell.points;
    const axes = (external?.length ?? 0) / (at.length / 3);
    this.mark.visible = at[3 * row] != null;
    if (this.mark.visible) {
      const size = this.extent * 0.009;
      this.mark.position.fromArray(at, 3 * row);
      this.mark.scale.setScalar(size);
    }
    if (this.robot && joints && joints[6 * row] != null) this.robot.pose(joints.slice(6 * row, 6 * row + 6), tool?.[row] ?? 0, external?.slice(axes * row, axes * (row + 1)));
    this.draw();
  }

  /** Looks at everything from a direction. */
  view(from) {
    const bounds = this.bounds.isEmpty() ? new Box3(new Vector3(-250, -250, 0), new Vector3(250, 250, 500)) : this.bounds.clone();
    if (this.robot) {
      const links = new Box3().setFromObject(this.robot.group);
      if (!links.isEmpty()) bounds.union(links);
    }
    const middle = bounds.getCenter(new Vector3());
    const away = Math.max(60, bounds.getSize(new Vector3()).length()) * 1.35;
    this.controls.target.copy(middle);
    this.camera.position.copy(middle).add(new Vector3(...from).normalize().multiplyScalar(away));
    this.camera.near = away / 500;
    this.camera.far = away * 30;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  /** Looks at the paths alone. */
  near() {
    const bounds = new Box3();
    const point = new Vector3();
    for (const path of this.cell.paths) {
      for (let k = 0; k + 2 < path.at.length; k += 3) bounds.expandByPoint(point.fromArray(path.at, k));
    }
    if (bounds.isEmpty()) return;
    const middle = bounds.getCenter(new Vector3());
    const away = Math.max(20, bounds.getSize(new Vector3()).length()) * 1.25;
    const direction = this.camera.position.clone().sub(this.controls.target).normalize();
    this.controls.target.copy(middle);
    this.camera.position.copy(middle).addScaledVector(direction, away);
    this.controls.update();
    this.draw();
  }

  listen(onpick) {
    let down = null;
    this.canvas.addEventListener("pointerdown", (event) => {
      down = [event.clientX, event.clientY];
    });
    this.canvas.addEventListener("pointerup", (event) => {
      if (!down || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4) return;
      const row = this.itemAt(event);
      if (row != null) onpick(row);
    });
    const turn = { ArrowLeft: [-0.12, 0], ArrowRight: [0.12, 0], ArrowUp: [0, 0.12], ArrowDown: [0, -0.12] };
    this.canvas.addEventListener("keydown", (event) => {
      const away = this.camera.position.clone().sub(this.controls.target);
      if (event.key in turn) {
        const [around, up] = turn[event.key];
        const flat = Math.hypot(away.x, away.y);
        const tilt = Math.max(-1.5, Math.min(1.5, Math.atan2(away.z, flat) + up));
        const heading = Math.atan2(away.y, away.x) + around;
        const far = away.length();
        away.set(Math.cos(heading) * Math.cos(tilt), Math.sin(heading) * Math.cos(tilt), Math.sin(tilt)).multiplyScalar(far);
      } else if (event.key === "+" || event.key === "=") away.multiplyScalar(0.85);
      else if (event.key === "-") away.multiplyScalar(1 / 0.85);
      else return;
      event.preventDefault();
      this.camera.position.copy(this.controls.target).add(away);
      this.turn();
      this.controls.update();
    });
  }

  /** The item drawn nearest to a pointer, within a few pixels. */
  itemAt(event) {
    const box = this.canvas.getBoundingClientRect();
    const pointer = new Vector2(event.clientX - box.left, event.clientY - box.top);
    const { at } = this.cell.points;
    const point = new Vector3();
    let best = null;
    let least = 12;
    for (const row of this.rows) {
      point.fromArray(at, 3 * row).project(this.camera);
      if (point.z > 1) continue;
      const apart = Math.hypot(((point.x + 1) / 2) * box.width - pointer.x, ((1 - point.y) / 2) * box.height - pointer.y);
      if (apart < least) [best, least] = [row, apart];
    }
    return best;
  }

  resize(box) {
    const [width, height] = [box.clientWidth, box.clientHeight];
    if (!width || !height) return;
    this.size = new Vector2(width, height);
    this.ratio = null;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** The view moves under somebody's hand: it is drawn fast, and in full when it rests. */
  turn() {
    this.turning = true;
    clearTimeout(this.rest);
    this.rest = setTimeout(() => {
      this.turning = false;
      this.last = null;
      this.draw();
    }, REST);
    this.draw();
  }

  /** While the view turns frames follow each other: when they come too late the next ones are coarser, and finer again when there is time. */
  pace(now) {
    const took = this.turning && this.last ? now - this.last : null;
    this.last = this.turning ? now : null;
    if (took == null || took > 400) return;
    this.late = took > SLOW ? (this.late ?? 0) + 1 : 0;
    this.early = took < SLOW / 2 ? (this.early ?? 0) + 1 : 0;
    if (this.late >= 3 && this.level + 1 < FINENESS.turning.length) [this.level, this.late] = [this.level + 1, 0];
    if (this.early >= 40 && this.level > 0) [this.level, this.early] = [this.level - 1, 0];
  }

  /** Draws with the next frame, however often it is asked. */
  draw() {
    if (this.waiting || !this.compiled) return;
    this.waiting = true;
    requestAnimationFrame((now) => {
      this.waiting = false;
      this.pace(now);
      this.render();
    });
  }

  render() {
    const { renderer, turning, level } = this;
    if (!this.size) return;
    const ratio = turning ? FINENESS.turning[level] * Math.min(devicePixelRatio, 2) : Math.max(FINENESS.rest, Math.min(devicePixelRatio, 3));
    if (ratio !== this.ratio) {
      this.ratio = ratio;
      renderer.setDrawingBufferSize(this.size.x, this.size.y, ratio);
    }
    const screen = this.size.clone().multiplyScalar(ratio);
    const coarse = turning && (level > 0 || this.layers.paths.some(({ path }) => path.at.length / 3 > WHILE_TURNING));
    for (const path of this.layers.paths) path.fineness(coarse, screen, ratio);
    this.items.geometry.setIndex(turning ? this.fewItems : this.allItems);
    this.items.material.uniforms.size.value = this.dotSize * ratio;
    renderer.render(this.scene, this.camera);
    const { triangles, lines: segments, points } = renderer.info.render;
    Object.assign(this.canvas.dataset, { drawn: turning ? "turning" : "full", parts: String(triangles + segments + points) });
    this.tellDrawn();
  }
}
