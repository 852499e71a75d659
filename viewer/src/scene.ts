// The 3-D picture: ground, obstacles, nodes, trails, frames on the air and their receptions.

import * as THREE from "three";
import { Air, Interferer, Picture } from "./air";
import { Camera } from "./camera";
import { groupColor, isDark, outcomeColor, rgb, styleColor } from "./colors";
import { deviceRatio } from "./dom";
import { senderOf } from "./frame_text";
import { pixelRatio, resolution } from "./instances";
import { Chunk, Frame, Replay } from "./replay";
import * as shapes from "./shapes";

/** Length of trails in simulated time. */
export const TRAIL_S = 30;

/** The groups of nodes, each of which has its shape and color. */
function groupsOf({ run }: Replay): string[] {
  return [...new Set(run.nodes.map((node) => node.group))];
}

export class Scene {
  readonly camera: Camera;
  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly origin = new THREE.Vector3();
  private readonly trails = shapes.lines(1);
  private readonly ranges = shapes.rings(2);
  private readonly air: Air;
  private readonly marks = shapes.marks(6);
  private readonly obstacles = new THREE.Group();
  private readonly ground: THREE.Mesh<THREE.PlaneGeometry, THREE.ShaderMaterial>;
  readonly groups: ReadonlyMap<string, number>;
  private background = "";
  private isPlaced = false; // whether `origin` is set: what is drawn depends on it

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly replay: Replay,
    onMove: () => void,
    groups: readonly string[] = groupsOf(replay),
  ) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.debug.checkShaderErrors = false; // Asking would wait for the compiler.
    this.camera = new Camera(canvas, onMove);
    this.groups = new Map(groups.map((name, index) => [name, index]));
    this.ground = new THREE.Mesh(
      new THREE.PlaneGeometry(1, 1),
      new THREE.ShaderMaterial({
        vertexShader: shapes.GROUND_VERTEX,
        fragmentShader: shapes.GROUND_FRAGMENT,
        uniforms: {
          origin: { value: new THREE.Vector2() },
          cell: { value: 100 },
          color: { value: [0, 0, 0] },
          fadeAt: { value: 1 },
        },
        transparent: true,
        depthWrite: false,
        side: THREE.DoubleSide,
      }),
    );
    this.ground.frustumCulled = false;
    this.ground.renderOrder = -2;
    const sun = new THREE.DirectionalLight(0xffffff, 1.6);
    sun.position.set(-0.5, -1, 1.6);
    this.scene.add(this.ground, this.obstacles, sun, new THREE.AmbientLight(0xffffff, 1.5));
    this.air = new Air(replay, (x, y, z) => this.place(x, y, z));
    for (const shape of [this.trails, this.ranges, ...this.air.shapes, this.marks]) this.scene.add(shape.mesh);
    this.applyTheme();
    isDark.addEventListener("change", () => {
      this.applyTheme();
      onMove();
    });
  }

  /** Where a position is in the picture: coordinates are from the middle, so that numbers stay small. */
  place(x: number, y: number, z: number): THREE.Vector3 {
    return new THREE.Vector3(x - this.origin.x, y - this.origin.y, z);
  }

  groupOf(node: number): number {
    return this.groups.get(this.replay.nodes.get(node)?.group ?? "") ?? 0;
  }

  /** Show all of these positions, given as x, y, z, x, …, and the obstacles. */
  fit(values: ArrayLike<number>, polar?: number): void {
    const corners = this.replay.run.obstacles.flatMap(({ points, top_m }) =>
      points.flatMap(([x, y]) => [x, y, Math.min(top_m, 1000)]),
    );
    const all = [...Array.from(values), ...corners];
    if (!this.isPlaced) {
      this.isPlaced = true;
      new THREE.Box3().setFromArray(all.filter((value) => !Number.isNaN(value))).getCenter(this.origin).setZ(0);
      this.ground.material.uniforms.origin.value.set(this.origin.x, this.origin.y);
      this.addObstacles();
    }
    this.zoomTo(all, polar);
  }

  zoomTo(values: ArrayLike<number>, polar?: number): void {
    const points: THREE.Vector3[] = [];
    for (let offset = 0; offset + 2 < values.length; offset += 3)
      if (!Number.isNaN(values[offset])) points.push(this.place(values[offset], values[offset + 1], values[offset + 2]));
    if (!points.length) points.push(new THREE.Vector3());
    this.resize();
    this.camera.fit(points, polar);
  }

  /** Zoom in on a frame, or else on a node; return whether there was one. */
  zoomIn(timeNs: number, frame: Frame | null, interferers: readonly Interferer[], node: number | null): boolean {
    if (frame !== null) {
      const receivers = frame.chunk.frames.receptions(frame.row).map(({ receiver }) => receiver);
      const nodes = [senderOf(frame), ...receivers, ...interferers.map((interferer) => interferer.node)];
      this.zoomTo(nodes.flatMap((one) => [...this.replay.position(one, frame)]));
    } else if (node !== null) {
      const [x, y, z] = this.replay.positions(timeNs).subarray(node * 3, node * 3 + 3);
      const range = this.replay.nodes.get(node)?.range_m ?? 50;
      this.zoomTo([x - range, y - range, z, x + range, y + range, z]);
    }
    return frame !== null || node !== null;
  }

  /** Look from where another scene does. */
  lookAs(other: Scene): void {
    this.camera.lookAs(other.camera, other.origin.clone().sub(this.origin));
  }

  draw(picture: Picture): void {
    this.resize();
    const { state, positions, look } = picture;
    if (look.background !== this.background) {
      this.background = look.background;
      document.documentElement.style.setProperty("--scene", look.background);
      this.applyTheme();
    }
    if (state.isFollowing && state.node !== null) {
      const at = state.node * 3;
      const range = this.replay.nodes.get(state.node)?.range_m ?? Infinity;
      this.camera.follow(this.place(positions[at], positions[at + 1], positions[at + 2]), range);
    } else this.camera.follow(null);
    this.camera.update();
    this.drawGround();
    this.drawTrails(picture);
    this.air.draw(picture);
    this.drawNodes(picture);
    this.renderer.render(this.scene, this.camera.camera);
  }

  private resize(): void {
    const ratio = Math.min(deviceRatio(), 3);
    const { clientWidth: width, clientHeight: height } = this.canvas;
    pixelRatio.value = ratio; // another scene may have another one
    this.renderer.getDrawingBufferSize(resolution.value);
    if (resolution.value.x === Math.floor(width * ratio) && resolution.value.y === Math.floor(height * ratio)) return;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.renderer.getDrawingBufferSize(resolution.value);
    this.camera.resize(Math.max(1, width), Math.max(1, height));
  }

  private drawGround(): void {
    const { distance, target } = this.camera;
    this.ground.scale.setScalar(distance * 40);
    this.ground.position.set(target.x, target.y, 0);
    this.ground.material.uniforms.cell.value = 10 ** Math.round(Math.log10(distance / 8));
    this.ground.material.uniforms.fadeAt.value = distance * 4;
  }

  private drawTrails({ timeNs, state, positions, look }: Picture): void {
    this.trails.clear();
    const ink = rgb(styleColor("--muted"));
    const fromNs = timeNs - TRAIL_S * 1e9;
    const start = new Float64Array(3);
    const chunks: Chunk[] = []; // by time, those that the trails go through
    for (const chunk of this.replay.chunksBefore(timeNs)) {
      if (chunk.stored.header.start_ns <= timeNs) chunks.unshift(chunk);
      if (chunk.stored.header.start_ns <= fromNs) break;
    }
    const crowd = Math.min(1, Math.sqrt(40 / this.replay.nodes.size));
    for (const node of this.replay.nodes.keys()) {
      const [x, y, z] = [positions[node * 3], positions[node * 3 + 1], positions[node * 3 + 2]];
      if (Number.isNaN(x)) continue;
      const isChosen = node === state.node;
      const color = look.colors.get(node) ?? rgb(groupColor(this.groupOf(node)));
      const strength = isChosen ? 0.9 : 0.7 * crowd * (state.node === null ? 1 : 0.5);
      const end = this.place(x, y, z);
      if (z > 0.5) this.trails.add(end.x, end.y, end.z, end.x, end.y, 0, ...ink, 0.5, 0.25, 1, 0);
      if (!chunks.length || !(state.trails || isChosen)) continue;
      chunks[0].legs.position(node, Math.max(0, fromNs), start);
      const corners = chunks.flatMap(({ legs, stored: { header } }, index) => [
        ...legs.corners(node, index === 0 ? fromNs : Math.max(fromNs, header.start_ns - 1), timeNs),
      ]);
      let [beforeNs, a] = [fromNs, this.place(start[0], start[1], start[2])];
      for (const [cornerNs, cx, cy, cz] of [...corners, [timeNs, x, y, z] as const]) {
        const b = this.place(cx, cy, cz);
        const [alphaA, alphaB] = [beforeNs, cornerNs].map((at) => strength * Math.max(0, 1 - (timeNs - at) / (TRAIL_S * 1e9)));
        if (a.distanceToSquared(b) > 1e-6)
          this.trails.add(a.x, a.y, a.z, b.x, b.y, b.z, ...color, alphaA, alphaB, isChosen ? 2.5 : 1.5, 0);
        [beforeNs, a] = [cornerNs, b];
      }
    }
    this.trails.show();
  }

  private drawNodes({ timeNs, positions, state, look, interferers }: Picture): void {
    this.marks.clear();
    this.ranges.clear();
    const accent = rgb(styleColor("--accent"));
    const interfering = new Set(state.frame ? interferers.map((interferer) => interferer.node) : []);
    const interference = rgb(outcomeColor("interference"));
    const usual = this.replay.nodes.size > 60 ? 9 : 13;
    for (const [node, { range_m }] of this.replay.nodes) {
      const point = this.place(positions[node * 3], positions[node * 3 + 1], positions[node * 3 + 2]);
      const { x, y, z } = point;
      if (Number.isNaN(x)) continue;
      const group = this.groupOf(node);
      const color = look.colors.get(node) ?? rgb(groupColor(group));
      const size = look.radiusM ? Math.max(4, 2 * look.radiusM * this.camera.pixelsPerMeter(point)) : usual;
      this.marks.add(x, y, z, ...color, 1, size, group % shapes.SHAPES, ...this.replay.heading(node, timeNs));
      if (interfering.has(node)) this.marks.add(x, y, z, ...interference, 1, size + 12, shapes.CIRCLE, 0, 0, 0);
      if (node !== state.node) continue;
      this.marks.add(x, y, z, ...accent, 1, size + 12, shapes.CIRCLE, 0, 0, 0);
      if (range_m !== null) this.ranges.add(x, y, z, range_m, ...accent, 0.8, 1.5);
    }
    this.marks.show();
    this.ranges.show();
  }

  private addObstacles(): void {
    const side = new THREE.MeshLambertMaterial({ transparent: true, opacity: 0.55, depthWrite: false });
    const edge = new THREE.LineBasicMaterial({ transparent: true, opacity: 0.8 });
    for (const { points, bottom_m, top_m } of this.replay.run.obstacles) {
      const outlinePoints = points.map(([x, y]) => new THREE.Vector2(x - this.origin.x, y - this.origin.y));
      const geometry = new THREE.ExtrudeGeometry(new THREE.Shape(outlinePoints), {
        depth: Math.min(top_m, 1e4) - bottom_m,
        bevelEnabled: false,
      }).translate(0, 0, bottom_m);
      const body = new THREE.Mesh(geometry, side);
      const edges = new THREE.LineSegments(new THREE.EdgesGeometry(geometry, 20), edge);
      body.renderOrder = edges.renderOrder = -1;
      this.obstacles.add(body, edges);
    }
    this.applyTheme();
  }

  private applyTheme(): void {
    shapes.outline.value = rgb(styleColor("--scene"));
    this.ground.material.uniforms.color.value = rgb(styleColor("--muted"));
    for (const child of this.obstacles.children) {
      const { material } = child as THREE.Mesh<THREE.BufferGeometry, THREE.MeshLambertMaterial>;
      material.color.setStyle(styleColor(child instanceof THREE.LineSegments ? "--muted" : "--obstacle"));
    }
  }
}
