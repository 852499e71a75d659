// The three kinds of shapes of the scene: lines of constant width, rings on a level, marks of constant size.

import { Instances } from "./instances";

const LINE_VERTEX = `
attribute vec3 from; attribute vec3 to; attribute vec4 color; attribute float alphaTo;
attribute float width; attribute float dash;
uniform vec2 resolution; uniform float pixelRatio;
varying vec4 vColor; varying float vSide; varying float vHalf; varying float vDash; varying vec2 vDistance;
void main() {
  vec4 a = modelViewMatrix * vec4(from, 1.0);
  vec4 b = modelViewMatrix * vec4(to, 1.0);
  float near = -0.5;
  // What is behind the camera is cut off.
  if (a.z > near && b.z > near) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  if (a.z > near) a.xyz = mix(a.xyz, b.xyz, (near - a.z) / (b.z - a.z));
  if (b.z > near) b.xyz = mix(b.xyz, a.xyz, (near - b.z) / (a.z - b.z));
  vec4 clipA = projectionMatrix * a;
  vec4 clipB = projectionMatrix * b;
  vec2 screenA = clipA.xy / clipA.w * resolution * 0.5;
  vec2 screenB = clipB.xy / clipB.w * resolution * 0.5;
  vec2 along = screenB - screenA;
  float reach = max(length(along), 1e-4);
  vec2 normal = vec2(-along.y, along.x) / reach;
  float end = step(0.0, position.x);
  vec4 clip = end > 0.5 ? clipB : clipA;
  vHalf = width * pixelRatio * 0.5;
  vSide = position.y * (vHalf + 1.0);
  clip.xy += normal * vSide / (resolution * 0.5) * clip.w;
  vColor = vec4(color.rgb, end > 0.5 ? alphaTo : color.a);
  vDash = dash * pixelRatio;
  vDistance = vec2(end * reach, 1.0) * clip.w; // linear on the screen, whatever the perspective
  gl_Position = clip;
}`;

const LINE_FRAGMENT = `
varying vec4 vColor; varying float vSide; varying float vHalf; varying float vDash; varying vec2 vDistance;
void main() {
  if (vDash > 0.0 && mod(vDistance.x / vDistance.y, vDash * 1.7) > vDash) discard;
  float alpha = vColor.a * clamp(vHalf + 0.5 - abs(vSide), 0.0, 1.0);
  if (alpha < 0.004) discard;
  gl_FragColor = vec4(vColor.rgb, alpha);
}`;

/** Lines: from, to, color, alpha at both ends, width in pixels, length of dashes (0: none). */
export function lines(order: number): Instances {
  const layout = { from: 3, to: 3, color: 4, alphaTo: 1, width: 1, dash: 1 };
  return new Instances(layout, LINE_VERTEX, LINE_FRAGMENT, {}, order);
}

const RING_VERTEX = `
attribute vec3 center; attribute float radius; attribute vec4 color; attribute float width;
varying vec2 vPlace; varying vec4 vColor; varying float vWidth; varying float vFill;
uniform vec2 resolution; uniform float pixelRatio;
void main() {
  vPlace = position.xy * 1.05;
  // From half the diagonal of the picture on, the edge may be out of view: the inside fades before.
  float depth = max(0.1, -(modelViewMatrix * vec4(center, 1.0)).z);
  float radiusPx = radius * projectionMatrix[1][1] / depth * resolution.y * 0.5;
  vFill = 0.06 * clamp(2.0 - radiusPx / length(resolution) * 4.0, 0.0, 1.0);
  vColor = color;
  vWidth = width * pixelRatio;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(center + vec3(vPlace * radius, 0.0), 1.0);
}`;

const RING_FRAGMENT = `
varying vec2 vPlace; varying vec4 vColor; varying float vWidth; varying float vFill;
void main() {
  float distance = length(vPlace);
  float pixel = max(fwidth(distance), 1e-6);
  float edge = abs(distance - 1.0) / pixel;
  float line = clamp(vWidth * 0.5 + 0.5 - edge, 0.0, 1.0);
  float alpha = vColor.a * max(line, distance < 1.0 ? vFill : 0.0);
  if (alpha < 0.002) discard;
  gl_FragColor = vec4(vColor.rgb, alpha);
}`;

/** Level circles: center, radius in meters, color with alpha, width of the line in pixels. */
export function rings(order: number): Instances {
  return new Instances({ center: 3, radius: 1, color: 4, width: 1 }, RING_VERTEX, RING_FRAGMENT, {}, order);
}

const MARK_VERTEX = `
attribute vec3 center; attribute vec4 color; attribute float size; attribute float shape; attribute vec3 heading;
uniform vec2 resolution; uniform float pixelRatio;
varying vec2 vPlace; varying vec4 vColor; varying float vSize; varying float vShape; varying vec2 vAhead;
void main() {
  vec4 clip = projectionMatrix * modelViewMatrix * vec4(center, 1.0);
  vec4 ahead = projectionMatrix * modelViewMatrix * vec4(center + heading * clip.w * 0.01, 1.0);
  vec2 step = (ahead.xy / ahead.w - clip.xy / clip.w) * resolution;
  vAhead = length(step) > 0.1 ? normalize(step) : vec2(0.0);
  vSize = size * pixelRatio * 0.5;
  vPlace = position.xy * (vSize * (1.0 + length(vAhead)) + 3.0 * pixelRatio);
  clip.xy += vPlace / (resolution * 0.5) * clip.w;
  vColor = color;
  vShape = shape;
  gl_Position = clip;
}`;

const MARK_FRAGMENT = `
uniform vec3 outline; uniform float pixelRatio;
varying vec2 vPlace; varying vec4 vColor; varying float vSize; varying float vShape; varying vec2 vAhead;
// A point in the direction in which a node moves.
float distanceToPoint(vec2 p) {
  vec2 q = vec2(abs(p.x * vAhead.y - p.y * vAhead.x), dot(p, vAhead));
  return length(vAhead) < 0.5 ? 1e6 : max(q.x * 0.91 + (q.y - vSize * 1.9) * 0.41, -q.y);
}
float distanceTo(vec2 p) {
  vec2 q = abs(p);
  if (vShape < 0.5) return length(p) - vSize;                                  // disc
  if (vShape < 1.5) return max(q.x, q.y) - vSize * 0.86;                       // square
  if (vShape < 2.5) return max(q.x * 0.866 + p.y * 0.5, -p.y) - vSize * 0.62;  // triangle
  if (vShape < 3.5) return (q.x + q.y) * 0.7071 - vSize * 0.8;                 // diamond
  return abs(length(p) - vSize) - 1.3 * pixelRatio;                            // circle
}
void main() {
  float distance = min(distanceTo(vPlace), distanceToPoint(vPlace));
  float border = vShape < 3.5 ? 1.5 * pixelRatio : 0.0;
  float alpha = clamp(border + 0.5 - distance, 0.0, 1.0) * vColor.a;
  if (alpha < 0.004) discard;
  float inside = clamp(0.5 - distance, 0.0, 1.0);
  gl_FragColor = vec4(mix(outline, vColor.rgb, inside), alpha);
}`;

export const SHAPES = 4;
export const CIRCLE = 4;

/** The color around a mark. */
export const outline = { value: [1, 1, 1] };

/** Marks: center, color with alpha, size in pixels, shape: 0 to 3, or CIRCLE, heading: of length 1, or 0. */
export function marks(order: number): Instances {
  const layout = { center: 3, color: 4, size: 1, shape: 1, heading: 3 };
  return new Instances(layout, MARK_VERTEX, MARK_FRAGMENT, { outline }, order);
}

export const GROUND_VERTEX = `
varying vec2 vPlace; varying float vDepth;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  vPlace = world.xy;
  vec4 view = viewMatrix * world;
  vDepth = -view.z;
  gl_Position = projectionMatrix * view;
}`;

export const GROUND_FRAGMENT = `
uniform vec2 origin; uniform float cell; uniform vec3 color; uniform float fadeAt;
varying vec2 vPlace; varying float vDepth;
float lineOf(float step) {
  vec2 place = (vPlace + origin) / step;
  vec2 pixel = fwidth(place);
  vec2 edge = abs(fract(place - 0.5) - 0.5) / max(pixel, 1e-6);
  float line = clamp(1.0 - min(edge.x, edge.y), 0.0, 1.0);
  return line * clamp(1.0 - max(pixel.x, pixel.y) * 3.0, 0.0, 1.0);
}
void main() {
  float alpha = max(lineOf(cell) * 0.22, lineOf(cell * 5.0) * 0.42) * clamp(1.6 - vDepth / fadeAt, 0.0, 1.0);
  if (alpha < 0.004) discard;
  gl_FragColor = vec4(color, alpha);
}`;
