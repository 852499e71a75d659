// The camera: moved with the mouse, with "show all", "top view" and by following a node.

import * as THREE from "three";
import { MapControls } from "three/addons/controls/MapControls.js";

/** Angle to the vertical at first. */
export const SLANT = Math.PI * 0.27;

const TOP_ROOM = 1.35;

export class Camera {
  readonly camera = new THREE.PerspectiveCamera(35, 1, 1, 1e6);
  private readonly controls: MapControls;
  private radius = 100;
  private heightPx = 1;
  private readonly followed = new THREE.Vector3(NaN, NaN, NaN);

  constructor(canvas: HTMLElement, onMove: () => void) {
    this.camera.up.set(0, 0, 1);
    this.controls = new MapControls(this.camera, canvas);
    this.controls.maxPolarAngle = Math.PI * 0.495;
    this.controls.zoomToCursor = true;
    this.controls.enableDamping = false;
    this.controls.addEventListener("change", onMove);
  }

  get target(): THREE.Vector3 {
    return this.controls.target;
  }

  get distance(): number {
    return this.camera.position.distanceTo(this.controls.target);
  }

  /** How long a meter is at a point, in pixels of the page. */
  pixelsPerMeter(point: THREE.Vector3): number {
    const distance = this.camera.position.distanceTo(point);
    return this.heightPx / (2 * distance * Math.tan(THREE.MathUtils.degToRad(this.camera.fov / 2)));
  }

  /** Whether it looks down. */
  get isTop(): boolean {
    return this.controls.getPolarAngle() < 0.01;
  }

  resize(width: number, height: number): void {
    this.heightPx = height;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  /** Show these points, from the direction from which it looks now, or from this angle to the vertical. */
  fit(points: readonly THREE.Vector3[], polar = this.controls.getPolarAngle()): void {
    const box = new THREE.Box3().setFromPoints([...points]);
    this.radius = Math.max(box.getBoundingSphere(new THREE.Sphere()).radius, 5);
    box.getCenter(this.controls.target);
    const azimuth = polar > 0.01 ? this.controls.getAzimuthalAngle() : 0;
    let distance = this.radius * 4;
    for (let step = 0; step < 6; step += 1) {
      this.place(distance, polar, azimuth);
      this.camera.updateMatrixWorld();
      const seen = new THREE.Box3().setFromPoints(points.map((point) => point.clone().project(this.camera)));
      const middle = seen.getCenter(new THREE.Vector3());
      const size = seen.getSize(new THREE.Vector3());
      const half = distance * Math.tan(THREE.MathUtils.degToRad(this.camera.fov / 2));
      this.controls.target.addScaledVector(this.axis(0), middle.x * half * this.camera.aspect);
      const ahead = this.axis(1).setZ(0);
      if (ahead.lengthSq() > 0.01) this.controls.target.addScaledVector(ahead.normalize(), middle.y * half);
      distance = Math.max(this.radius * 0.2, 15, distance * Math.max(size.x * 0.6, size.y * 0.58));
    }
    this.place(distance, polar, azimuth);
  }

  /** Look from where another camera does, whose coordinates begin at `shift`. */
  lookAs(other: Camera, shift: THREE.Vector3): void {
    const [point, target] = [other.camera.position, other.target].map((one) => one.clone().add(shift));
    if (point.equals(this.camera.position) && target.equals(this.target)) return;
    this.camera.position.copy(point);
    this.controls.target.copy(target);
    this.controls.update();
  }

  /** Look down, or slanting again. */
  toggleTop(): void {
    // From above the ground is not foreshortened: it takes more room.
    if (this.isTop) this.place(this.distance / TOP_ROOM, SLANT, 0);
    else this.place(this.distance * TOP_ROOM, 0, 0);
  }

  /** Keep a node where it is on the screen, at first in the middle and near; null: follow none. */
  follow(point: THREE.Vector3 | null, range = Infinity): void {
    if (point === null) {
      this.followed.x = NaN;
      return;
    }
    const isNew = Number.isNaN(this.followed.x);
    const step = point.clone().sub(isNew ? this.controls.target : this.followed);
    this.followed.copy(point);
    if (isNew && this.distance > range * 5) {
      this.controls.target.copy(point);
      this.place(range * 5, this.controls.getPolarAngle(), this.controls.getAzimuthalAngle());
      return;
    }
    if (step.lengthSq() === 0) return;
    this.camera.position.add(step);
    this.controls.target.add(step);
    this.controls.update();
  }

  /** Adapt near and far planes to what is seen. */
  update(): void {
    const distance = this.camera.position.length();
    this.camera.near = Math.max(0.1, Math.min(this.distance, this.camera.position.z + 1) / 100);
    this.camera.far = Math.max((distance + this.radius) * 20, this.camera.near * 10);
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
  }

  /** Where right (0) or up (1) of the picture are in space. */
  private axis(column: number): THREE.Vector3 {
    return new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, column);
  }

  private place(distance: number, polar: number, azimuth: number): void {
    const { target } = this.controls;
    this.camera.position.set(
      target.x + distance * Math.sin(polar) * Math.sin(azimuth),
      target.y - distance * Math.sin(polar) * Math.cos(azimuth),
      target.z + distance * Math.cos(polar),
    );
    this.controls.update();
  }
}
