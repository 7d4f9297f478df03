// What solids, lines and dots are painted with: a few small shaders, which also a browser without a graphics card compiles and draws fast.
import {
  BufferAttribute, BufferGeometry, DoubleSide, FrontSide, InterleavedBuffer, InterleavedBufferAttribute, LineSegments, Mesh, ShaderMaterial, Sphere, Vector2,
} from "three";

/** A solid with light from behind the viewer's right shoulder. */
export function solid(color, { opacity = 1, bothSides = false, onTop = false, flat = false } = {}) {
  return new ShaderMaterial({
    uniforms: { color: { value: color }, opacity: { value: opacity }, shade: { value: flat ? 0 : 0.42 } },
    vertexShader: "varying vec3 facing; void main() { facing = normalMatrix * normal; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }",
    fragmentShader: `
      uniform vec3 color; uniform float opacity, shade; varying vec3 facing;
      void main() {
        vec3 n = facing * (gl_FrontFacing ? 1.0 : -1.0);
        float size = length(n);
        float lit = size > 0.0 ? max(0.0, dot(n / size, vec3(0.37, 0.46, 0.81))) : 0.5;
        gl_FragColor = vec4(color * (1.0 + shade * 0.25 - shade * (1.0 - lit)), opacity);
      }`,
    transparent: opacity < 1,
    depthWrite: opacity >= 1,
    depthTest: !onTop,
    side: bothSides ? DoubleSide : FrontSide,
    forceSinglePass: true,
  });
}

/** Thin lines, each corner with its tint. */
function thin({ opacity = 1, onTop = false } = {}) {
  return new ShaderMaterial({
    uniforms: { opacity: { value: opacity } },
    vertexShader: "attribute vec3 tint; varying vec3 colour; void main() { colour = tint; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }",
    fragmentShader: "uniform float opacity; varying vec3 colour; void main() { gl_FragColor = vec4(colour, opacity); }",
    transparent: opacity < 1,
    depthTest: !onTop,
  });
}

/** Lines between pairs of corners. */
export function lines(corners, tints, options) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(corners), 3));
  geometry.setAttribute("tint", new BufferAttribute(new Float32Array(tints), 3));
  return new LineSegments(geometry, thin(options));
}

/** Round dots of a size in pixels. */
export function dots() {
  return new ShaderMaterial({
    uniforms: { size: { value: 5 } },
    vertexShader: "attribute vec3 tint; uniform float size; varying vec3 colour; void main() { colour = tint; gl_PointSize = size; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }",
    fragmentShader: "varying vec3 colour; void main() { vec2 out_ = gl_PointCoord - 0.5; if (dot(out_, out_) > 0.25) discard; gl_FragColor = vec4(colour, 1.0); }",
  });
}

// two triangles for each line, spread on the screen; without instances, which are slow where there is no graphics card
const WIDE = `
  attribute vec3 from, to, tintFrom, tintTo;
  uniform vec2 screen; uniform float width; varying vec3 colour;
  void main() {
    vec2 side = vec2(gl_VertexID & 1, (gl_VertexID & 2) - 1);
    colour = mix(tintFrom, tintTo, side.x);
    vec4 a = projectionMatrix * modelViewMatrix * vec4(from, 1.0);
    vec4 b = projectionMatrix * modelViewMatrix * vec4(to, 1.0);
    float near = 1e-3;
    if (a.w < near && b.w < near) { gl_Position = vec4(0.0, 0.0, 2.0, 1.0); return; }
    if (a.w < near) a = mix(b, a, (b.w - near) / (b.w - a.w));
    if (b.w < near) b = mix(a, b, (a.w - near) / (a.w - b.w));
    vec2 along = (b.xy / b.w - a.xy / a.w) * screen;
    float size = length(along);
    along = size > 1e-6 ? along / size : vec2(1.0, 0.0);
    vec4 here = side.x < 0.5 ? a : b;
    vec2 across = vec2(-along.y, along.x) * side.y + along * (side.x - 0.5) * 0.7;
    here.xy += across * width / screen * here.w;
    gl_Position = here;
  }`;
/** Corners of a line on the screen, each with a copy of its sample. */
const CORNERS = 4;

/**
 * Lines through samples: wide ones, and thin ones that leave samples out, about `most` of them. `starts` are the samples where a
 * new line begins. `place(of)` puts sample `k` where `of(k, axis)` says.
 */
export function paths(count, starts, tintOf, most) {
  const begins = new Set(starts);
  const samples = new Float32Array(count * CORNERS * 3);
  const tints = new Uint8Array(count * CORNERS * 4);
  for (let k = 0; k < count; k += 1) {
    const tint = tintOf(k);
    for (let n = 4 * CORNERS * k; n < 4 * CORNERS * (k + 1); n += 4) tints.set(tint, n);
  }
  const [places, colours] = [new InterleavedBuffer(samples, 3), new InterleavedBuffer(tints, 4)];
  // a corner reads its own sample, and four copies on the next one
  const own = (buffer, size) => new InterleavedBufferAttribute(buffer, size, 0, buffer === colours);
  const next = (buffer, size) => new InterleavedBufferAttribute(buffer, size, CORNERS * buffer.stride, buffer === colours);
  const full = new BufferGeometry();
  for (const [name, attribute] of [["from", own(places, 3)], ["to", next(places, 3)], ["tintFrom", own(colours, 3)], ["tintTo", next(colours, 3)]]) full.setAttribute(name, attribute);
  const triangles = [];
  for (let k = 0; k + 1 < count; k += 1) {
    const v = CORNERS * k;
    if (!begins.has(k + 1)) triangles.push(v, v + 1, v + 2, v + 2, v + 1, v + 3);
  }
  full.setIndex(new BufferAttribute(new Uint32Array(triangles), 1));
  const material = new ShaderMaterial({
    uniforms: { screen: { value: new Vector2(1, 1) }, width: { value: 2 } },
    vertexShader: WIDE,
    fragmentShader: "varying vec3 colour; void main() { gl_FragColor = vec4(colour, 1.0); }",
    side: DoubleSide,
  });
  const wide = new Mesh(full, material);
  const coarse = new BufferGeometry();
  coarse.setAttribute("position", own(places, 3));
  coarse.setAttribute("tint", own(colours, 3));
  coarse.setIndex(new BufferAttribute(coarsePairs(count, begins, most).map((k) => CORNERS * k), 1));
  const narrow = new LineSegments(coarse, thin());
  for (const object of [wide, narrow]) {
    object.frustumCulled = false;
    // nothing is sorted by where it is: it need not be found out
    object.geometry.boundingSphere = new Sphere();
  }
  const place = (of) => {
    for (let k = 0, n = 0; k < count; k += 1) {
      const [x, y, z] = [of(k, 0), of(k, 1), of(k, 2)];
      for (let corner = 0; corner < CORNERS; corner += 1, n += 3) [samples[n], samples[n + 1], samples[n + 2]] = [x, y, z];
    }
    places.needsUpdate = true;
  };
  return { wide, narrow, place };
}

/** Pairs of samples, about `most`, that draw every line with its ends. */
export function coarsePairs(count, begins, most) {
  const step = Math.max(1, Math.ceil(count / most));
  const pairs = [];
  let last = 0;
  for (let k = 1; k <= count; k += 1) {
    if (k === count || begins.has(k)) {
      if (k - 1 > last) pairs.push(last, k - 1);
      last = k;
    } else if (k - last >= step) {
      pairs.push(last, k);
      last = k;
    }
  }
  return new Uint32Array(pairs);
}
