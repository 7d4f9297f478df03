// The robot: its chain, and what its links look like. Lengths in mm, z up.
import {
  BoxGeometry, BufferAttribute, BufferGeometry, CapsuleGeometry, Color, CylinderGeometry, Group, Matrix4, Mesh, PlaneGeometry, Quaternion, SphereGeometry, Vector3,
} from "three";
import { lines, solid } from "./paint.js";

const RAD = Math.PI / 180;
const UP = new Vector3(0, 1, 0);
const Z = new Vector3(0, 0, 1);

const matrix = (columns) => new Matrix4().fromArray(columns);

/** A cylinder or capsule from one point to another. */
function between(from, to, radius, make) {
  const [a, b] = [new Vector3(...from), new Vector3(...to)];
  const along = b.clone().sub(a);
  const geometry = make(radius, along.length());
  const turned = new Quaternion();
  if (along.length() > 1e-9) turned.setFromUnitVectors(UP, along.clone().normalize());
  geometry.applyQuaternion(turned);
  geometry.translate(...a.add(b).multiplyScalar(0.5).toArray());
  return geometry;
}

/** The geometry of a form as the page's JSON has it. */
function geometryOf(form) {
  switch (form.form) {
    case "capsule":
      return between(form.from, form.to, form.radius, (radius, length) => new CapsuleGeometry(radius, length, 8, 24));
    case "box":
      return new BoxGeometry(...form.size);
    case "sphere":
      return new SphereGeometry(form.radius, 32, 20);
    case "cylinder":
      return new CylinderGeometry(form.radius, form.radius, form.height, 32).rotateX(Math.PI / 2);
    case "plane": {
      const normal = new Vector3(...form.normal);
      const plane = new PlaneGeometry(4000, 4000);
      plane.applyQuaternion(new Quaternion().setFromUnitVectors(Z, normal));
      return plane.translate(...normal.multiplyScalar(form.offset).toArray());
    }
    default: {
      const mesh = new BufferGeometry();
      mesh.setAttribute("position", new BufferAttribute(new Float32Array(form.corners), 3));
      mesh.computeVertexNormals();
      return mesh;
    }
  }
}

/** A body with a colour. */
export function bodyOf(shape, colour, opacity = 1) {
  // what is closed hides its own inside
  const bothSides = !["capsule", "box", "sphere", "cylinder"].includes(shape.form);
  const mesh = new Mesh(geometryOf(shape), solid(new Color(colour), { opacity, bothSides }));
  mesh.applyMatrix4(matrix(shape.at));
  return mesh;
}

/** Three short lines along the axes of a frame. */
export function triad(length) {
  const corners = [0, 0, 0, length, 0, 0, 0, 0, 0, 0, length, 0, 0, 0, 0, 0, 0, length];
  const tints = [0.84, 0.2, 0.2, 0.84, 0.2, 0.2, 0.1, 0.6, 0.25, 0.1, 0.6, 0.25, 0.15, 0.4, 0.9, 0.15, 0.4, 0.9];
  const axes = lines(corners, tints, { onTop: true });
  axes.renderOrder = 3;
  return axes;
}

/** The frames of base and links at controller's joint angles in degrees. */
export function frames(robot, joints) {
  const out = [matrix(robot.base)];
  for (let i = 0; i < 6; i += 1) {
    let turned = joints[i];
    for (const { joint, on, ratio } of robot.coupling) if (joint === i) turned += ratio * joints[on];
    const [alpha, a, beta, theta, d] = robot.rows[i];
    const angle = (theta + robot.sign[i] * turned + robot.offset[i]) * RAD;
    const link = new Matrix4().makeRotationX(alpha * RAD)
      .multiply(new Matrix4().makeTranslation(a, 0, 0))
      .multiply(new Matrix4().makeRotationY(beta * RAD))
      .multiply(new Matrix4().makeRotationZ(angle))
      .multiply(new Matrix4().makeTranslation(0, 0, d));
    out.push(out[i].clone().multiply(link));
  }
  return out;
}

/** The linear axes that carry a base, each a bar along its travel and carried by those below it. */
function makeTrack(track, base, thick) {
  const group = new Group();
  const origin = new Vector3().setFromMatrixPosition(matrix(base));
  const material = solid(new Color(0x6d7684), { opacity: 0.7 });
  const rails = track.map(({ direction, zero, min, max }) => {
    const along = new Vector3(...direction);
    const [from, to] = [min, max].map((e) => origin.clone().addScaledVector(along, e - zero).toArray());
    const bar = new Mesh(between(from, to, thick, (half, length) => new BoxGeometry(2 * half, length, 2 * half)), material);
    group.add(bar);
    return { bar, along, zero };
  });
  /** Where the base is carried to. */
  const pose = (values) => {
    const moved = new Vector3();
    rails.forEach(({ bar, along, zero }, axis) => {
      bar.position.copy(moved);
      moved.addScaledVector(along, (values?.[axis] ?? zero) - zero);
    });
    return moved;
  };
  return { group, pose };
}

/** The plate of a positioner with what rides on it; it is not shown where nobody knows where its axes stand. */
function makeStation({ name, first, axes, plate, shapes }, radius) {
  const group = new Group();
  group.name = `plate of ${name}`;
  group.matrixAutoUpdate = false;
  const disc = new Mesh(new CylinderGeometry(radius, radius, 0.08 * radius, 48).rotateX(Math.PI / 2).translate(0, 0, -0.04 * radius), solid(new Color(0x6d7684), { opacity: 0.7 }));
  group.add(disc, triad(0.6 * radius));
  for (const shape of shapes) group.add(bodyOf(shape, 0x9a7b4f, 0.6));
  const pose = (values) => {
    group.visible = axes.every((_, k) => values?.[first + k] != null);
    if (!group.visible) return;
    const frame = new Matrix4();
    axes.forEach(({ at, sign, zero }, k) => {
      frame.multiply(matrix(at)).multiply(new Matrix4().makeRotationZ(sign * (values[first + k] - zero) * RAD));
    });
    group.matrix.copy(frame.multiply(matrix(plate)));
    group.matrixWorldNeedsUpdate = true;
  };
  return { group, pose };
}

/** A robot that can be posed, with the rail that carries it and the positioners next to it. */
export function makeRobot(robot) {
  const group = new Group();
  const links = Array.from({ length: 7 }, () => new Group());
  links.forEach((link, index) => {
    link.name = index ? `link ${index}` : "base";
    link.matrixAutoUpdate = false;
    group.add(link);
  });
  const sticks = new Group();
  const stick = solid(new Color(0x8a94a3));
  group.add(sticks);
  const hasShapes = robot.shapes.length > 0;
  for (const shape of robot.shapes) {
    const body = bodyOf(shape, shape.attached ? 0x9a7b4f : shape.link % 2 ? 0xd98a3d : 0xc9ced6, 0.42);
    body.renderOrder = 2;
    links[shape.link].add(body);
  }
  const reach = robot.rows.reduce((sum, row) => sum + Math.abs(row[1]) + Math.abs(row[4]), 1);
  const tip = triad(Math.max(20, reach * 0.06));
  tip.name = "tool";
  tip.matrixAutoUpdate = false;
  group.add(tip);
  const track = makeTrack(robot.external?.track ?? [], robot.base, reach * 0.02);
  const stations = (robot.external?.positioners ?? []).map((station) => makeStation(station, reach * 0.12));
  group.add(track.group, ...stations.map((station) => station.group));

  function pose(joints, tool, values) {
    const carried = new Matrix4().setPosition(track.pose(values));
    for (const station of stations) station.pose(values);
    const all = frames(robot, joints).map((frame) => carried.clone().multiply(frame));
    const flange = all[6].clone().multiply(matrix(robot.flange));
    const end = flange.clone().multiply(matrix(robot.tools[tool] ?? robot.tools[0]));
    all.forEach((frame, index) => {
      links[index].matrix.copy(frame);
      links[index].matrixWorldNeedsUpdate = true;
    });
    tip.matrix.copy(end);
    tip.matrixWorldNeedsUpdate = true;
    for (const old of sticks.children) old.geometry.dispose();
    sticks.clear();
    const origins = [...all, flange, end].map((frame) => new Vector3().setFromMatrixPosition(frame).toArray());
    const radius = reach * (hasShapes ? 0.006 : 0.016);
    for (let i = 0; i + 1 < origins.length; i += 1) {
      const apart = Math.hypot(...origins[i].map((x, k) => x - origins[i + 1][k]));
      if (apart > 0.5) {
        const thin = i >= 6 ? radius * 0.6 : radius;
        sticks.add(new Mesh(between(origins[i], origins[i + 1], thin, (r, length) => new CapsuleGeometry(r, length, 4, 12)), stick));
      }
    }
  }
  // until an item is chosen
  pose([0, 0, 0, 0, 0, 0], 0);
  return { group, pose };
}
