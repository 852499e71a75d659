// Many alike shapes in one draw call: each is a square that a shader shapes, from a row of numbers.

import * as THREE from "three";

export type Layout = Record<string, number>; // name of an attribute -> how many numbers

export class Instances {
  readonly mesh: THREE.Mesh<THREE.InstancedBufferGeometry, THREE.ShaderMaterial>;
  private readonly stride: number;
  private data = new Float32Array(0);
  private used = 0;

  constructor(
    private readonly layout: Layout,
    vertexShader: string,
    fragmentShader: string,
    uniforms: Record<string, THREE.IUniform> = {},
    order = 0,
  ) {
    this.stride = Object.values(layout).reduce((sum, size) => sum + size, 0);
    const geometry = new THREE.InstancedBufferGeometry();
    const corners = new Float32Array([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]);
    geometry.setAttribute("position", new THREE.BufferAttribute(corners, 3));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    const material = new THREE.ShaderMaterial({
      vertexShader,
      fragmentShader,
      uniforms: { resolution, pixelRatio, ...uniforms },
      transparent: true,
      depthWrite: false,
      side: THREE.DoubleSide,
    });
    this.mesh = new THREE.Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = order;
    this.grow(64);
  }

  clear(): void {
    this.used = 0;
  }

  add(...row: number[]): void {
    if (this.used + this.stride > this.data.length) this.grow((2 * this.data.length) / this.stride);
    for (let offset = 0; offset < row.length; offset += 1) this.data[this.used + offset] = row[offset];
    this.used += this.stride;
  }

  /** Make what was added visible. */
  show(): void {
    const { geometry } = this.mesh;
    geometry.instanceCount = this.used / this.stride;
    const attribute = geometry.getAttribute(Object.keys(this.layout)[0]) as THREE.InterleavedBufferAttribute;
    const buffer = attribute.data;
    buffer.clearUpdateRanges();
    buffer.addUpdateRange(0, this.used);
    buffer.needsUpdate = true;
  }

  private grow(rows: number): void {
    const data = new Float32Array(rows * this.stride);
    data.set(this.data.subarray(0, this.used));
    this.data = data;
    const { geometry } = this.mesh;
    geometry.dispose();
    const buffer = new THREE.InstancedInterleavedBuffer(data, this.stride);
    buffer.setUsage(THREE.DynamicDrawUsage);
    let offset = 0;
    for (const [name, size] of Object.entries(this.layout)) {
      geometry.setAttribute(name, new THREE.InterleavedBufferAttribute(buffer, size, offset));
      offset += size;
    }
  }
}

/** Size of the canvas in device pixels, and how many of these are a pixel of the page. */
export const resolution = { value: new THREE.Vector2(1, 1) };
export const pixelRatio = { value: 1 };
