// The view in space: robot, bodies, points that can be chosen, paths and vectors whose deviations are magnified.
import { interpolateTurbo } from "d3-scale-chromatic";
import {
  AmbientLight, Box3, BufferAttribute, BufferGeometry, CanvasTexture, Color, DirectionalLight, DoubleSide, GridHelper, Group, LineBasicMaterial, LineSegments, Matrix4, Mesh,
  MeshBasicMaterial, MeshLambertMaterial, PerspectiveCamera, Points, PointsMaterial, Scene, SphereGeometry, Vector2, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { bodyOf, makeRobot } from "./robot.js";

/** Error 0 to 1 as a colour; the ends of the ramp, too dark on both grounds, are left out. */
export const ramp = (part) => interpolateTurbo(0.1 + 0.8 * Math.max(0, Math.min(1, part)));

const css = (name) => new Color(getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim() || "#888");

/** Lines of a path that are drawn wide. */
const MANY = 6000;

/** Lines between neighbours of a path, each shifted by its deviation times a magnification. */
class Path {
  constructor(path, colourOf, width) {
    this.path = path;
    const { at, by, starts } = path;
    const count = at.length / 3;
    const ends = new Set(starts);
    this.pairs = [];
    for (let k = 1; k < count; k += 1) if (!ends.has(k)) this.pairs.push(k);
    this.ends = new Float32Array(this.pairs.length * 6);
    const colours = new Float32Array(this.pairs.length * 6);
    const colour = new Color();
    this.pairs.forEach((k, n) => {
      for (const [side, sample] of [[0, k - 1], [3, k]]) {
        colour.set(colourOf(sample));
        colour.toArray(colours, n * 6 + side);
      }
    });
    // wide lines cost a little mesh each; many lines are dense enough when thin
    this.wide = this.pairs.length <= MANY;
    if (this.wide) {
      this.geometry = new LineSegmentsGeometry();
      this.geometry.setPositions(this.ends);
      this.geometry.setColors(colours);
      this.lines = new LineSegments2(this.geometry, new LineMaterial({ linewidth: width, vertexColors: true }));
    } else {
      this.geometry = new BufferGeometry();
      this.geometry.setAttribute("position", new BufferAttribute(this.ends, 3));
      this.geometry.setAttribute("color", new BufferAttribute(colours, 3));
      this.lines = new LineSegments(this.geometry, new LineBasicMaterial({ vertexColors: true }));
    }
    this.shift(by ? 1 : 0);
    this.lines.frustumCulled = false;
  }

  shift(times) {
    const { at, by } = this.path;
    this.pairs.forEach((k, n) => {
      for (const [side, sample] of [[0, k - 1], [3, k]]) {
        for (let axis = 0; axis < 3; axis += 1) {
          const i = sample * 3 + axis;
          this.ends[n * 6 + side + axis] = at[i] + (by ? times * by[i] : 0);
        }
      }
    });
    if (this.wide) {
      const { data } = this.geometry.attributes.instanceStart;
      data.array.set(this.ends);
      data.needsUpdate = true;
    } else {
      this.geometry.attributes.position.needsUpdate = true;
    }
  }
}

/** A round dot for points. */
function disc() {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [32, 32];
  const pen = canvas.getContext("2d");
  pen.fillStyle = "#fff";
  pen.beginPath();
  pen.arc(16, 16, 15, 0, 2 * Math.PI);
  pen.fill();
  return new CanvasTexture(canvas);
}

/** Shows a cell. Throws where the browser has no WebGL. */
export class View {
  constructor(box, cell, onpick) {
    this.cell = cell;
    this.renderer = new WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", `${cell.title}: arrow keys turn, plus and minus come nearer and go away`);
    box.append(this.canvas);
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(38, 1, 1, 1e5);
    this.camera.up.set(0, 0, 1);
    const sun = new DirectionalLight(0xffffff, 2.2);
    sun.position.set(1, -1.4, 2.4);
    this.camera.add(sun);
    this.scene.add(new AmbientLight(0xffffff, 1.6), this.camera);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.addEventListener("change", () => this.draw());
    this.layers = { paths: [] };
    this.magnification = 1;
    this.build();
    this.view([1, -1.2, 0.75]);
    this.listen(onpick);
    new ResizeObserver(() => this.resize(box)).observe(box);
    this.resize(box);
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
      const base = css(path.tone);
      const size = (k) => Math.hypot(path.by[3 * k], path.by[3 * k + 1], path.by[3 * k + 2]);
      const colourOf = path.by && path.graded ? (k) => ramp(size(k) / this.worst) : () => base;
      const shown = new Path(path, colourOf, path.by ? 2.6 : 1.6);
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
    const grid = new GridHelper(size, 16, 0x888888, 0x888888);
    grid.material.transparent = true;
    grid.material.opacity = 0.18;
    grid.rotateX(Math.PI / 2);
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
    const colour = new Color();
    const { error } = this.cell.points;
    const most = (error ?? []).reduce((top, x) => Math.max(top, x ?? 0), 1e-12);
    this.rows.forEach((row, n) => {
      places.set(at.slice(3 * row, 3 * row + 3), 3 * n);
      if (error?.[row] == null) colour.copy(css("wanted"));
      else colour.set(ramp(error[row] / most));
      colour.toArray(colours, 3 * n);
    });
    geometry.setAttribute("position", new BufferAttribute(places, 3));
    geometry.setAttribute("color", new BufferAttribute(colours, 3));
    const size = (count > 2000 ? 3 : 5.5) * this.renderer.getPixelRatio();
    this.items = new Points(geometry, new PointsMaterial({ size, sizeAttenuation: false, vertexColors: true, map: disc(), alphaTest: 0.5 }));
    this.items.frustumCulled = false;
    this.scene.add(this.items);
    const ring = new MeshBasicMaterial({ color: 0xe6007e, transparent: true, opacity: 0.9, depthTest: false });
    this.mark = new Mesh(new SphereGeometry(1, 20, 14), ring);
    this.mark.renderOrder = 4;
    this.mark.visible = false;
    this.scene.add(this.mark);
  }

  placeEllipsoids() {
    this.ellipsoids = [];
    const material = new MeshLambertMaterial({ color: css("after"), transparent: true, opacity: 0.4, side: DoubleSide, depthWrite: false });
    for (const { at, axes } of this.cell.ellipsoids ?? []) {
      const mesh = new Mesh(new SphereGeometry(1, 24, 16), material);
      mesh.matrixAutoUpdate = false;
      this.scene.add(mesh);
      this.ellipsoids.push({ mesh, at, axes });
    }
  }

  magnify(times) {
    this.magnification = times;
    for (const path of this.layers.paths) if (path.path.by) path.shift(times);
    for (const { mesh, at, axes } of this.ellipsoids) {
      const [u, v, w] = [0, 3, 6].map((k) => axes.slice(k, k + 3).map((x) => x * times));
      mesh.matrix.set(u[0], v[0], w[0], at[0], u[1], v[1], w[1], at[1], u[2], v[2], w[2], at[2], 0, 0, 0, 1);
      mesh.matrixWorldNeedsUpdate = true;
    }
    this.draw();
  }

  select(row) {
    const { at, joints, tool } = this.cell.points;
    this.mark.visible = at[3 * row] != null;
    if (this.mark.visible) {
      const size = this.extent * 0.009;
      this.mark.position.fromArray(at, 3 * row);
      this.mark.scale.setScalar(size);
    }
    if (this.robot && joints && joints[6 * row] != null) this.robot.pose(joints.slice(6 * row, 6 * row + 6), tool?.[row] ?? 0);
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
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** Draws with the next frame, however often it is asked. */
  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.renderer.render(this.scene, this.camera);
    });
  }
}
