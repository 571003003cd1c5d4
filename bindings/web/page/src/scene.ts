// SPDX-License-Identifier: GPL-3.0-or-later
// The relief in WebGL with rim and scale bar. Shading is slight: colours match the legend. Draws only after
// changes. Only this file needs three.js; loaded with the first picture.

import {
  BufferAttribute,
  BufferGeometry,
  ColorManagement,
  DoubleSide,
  LinearSRGBColorSpace,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from 'three';
import { barFor, heightsOf, spanOf, type Attitude, type Field } from './pictures';
import { extentOf } from './units';

/** A label position, px from the top left. */
export interface Anchor {
  name: 'x' | 'y' | 'z';
  left: number;
  top: number;
  outward: number; // -1 left, 1 right
}

export class ReliefScene {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(26, 1, 0.05, 30);
  private mesh: Mesh<BufferGeometry, MeshBasicMaterial> | undefined;
  private frame: LineSegments<BufferGeometry, LineBasicMaterial> | undefined;
  private readonly corners: Record<'x' | 'y' | 'z', Vector3[]> = { x: [], y: [], z: [] };
  private ink = 0x444444;

  constructor(readonly canvas: HTMLCanvasElement) {
    ColorManagement.enabled = false;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.setClearColor(0x000000, 0);
    this.camera.up.set(0, 0, 1);
  }

  resize(width: number, height: number, ratio: number): void {
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  setInk(colour: string): void {
    this.ink = parseInt(colour.slice(1), 16);
    this.frame?.material.color.setHex(this.ink);
  }

  /** Flat without `relief`; `colours`: three bytes a node. */
  show({ nx, ny, size_x, size_y }: Field, relief: Field | undefined, colours: Uint8Array, exaggeration: number): void {
    this.clear();
    const heights = relief && heightsOf(relief);
    const side = Math.max(size_x, size_y);
    const [width, depth] = [size_x / side, size_y / side];
    const up = exaggeration / side;
    const known = (k: number): boolean => !heights || Number.isFinite(heights[k]);
    const extent = extentOf(heights ?? []);
    const [low, high] = extent[0] > extent[1] ? [0, 0] : extent;
    const heightAt = (k: number): number => (heights && known(k) ? heights[k] : low) - (low + high) / 2;
    const z = new Float32Array(nx * ny).map((_, k) => heightAt(k) * up);
    const positions = new Float32Array(3 * nx * ny);
    for (let j = 0, k = 0; j < ny; ++j) {
      for (let i = 0; i < nx; ++i, ++k) {
        positions[3 * k] = nx > 1 ? (i / (nx - 1) - 0.5) * width : 0;
        positions[3 * k + 1] = ny > 1 ? (j / (ny - 1) - 0.5) * depth : 0;
        positions[3 * k + 2] = z[k];
      }
    }
    // A missing corner leaves a hole.
    const triangles = new Uint32Array(6 * Math.max(0, nx - 1) * Math.max(0, ny - 1));
    let count = 0;
    for (let j = 0; j + 1 < ny; ++j) {
      for (let i = 0; i + 1 < nx; ++i) {
        const k = j * nx + i;
        for (const corners of [
          [k, k + 1, k + nx],
          [k + 1, k + nx + 1, k + nx],
        ]) {
          if (!corners.every(known)) continue;
          triangles.set(corners, count);
          count += 3;
        }
      }
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(positions, 3));
    geometry.setAttribute('color', new BufferAttribute(shaded(colours, z, known, nx, ny, width, depth), 3, true));
    geometry.setIndex(new BufferAttribute(triangles.subarray(0, count), 1));
    this.mesh = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true, side: DoubleSide }));
    this.scene.add(this.mesh);

    const floor = (-(high - low) / 2) * up - 0.03;
    const [a, b] = [width / 2, depth / 2];
    const at = (x: number, y: number, h = floor): Vector3 => new Vector3(x, y, h);
    const rim = [at(-a, -b), at(a, -b), at(a, b), at(-a, b)];
    const lines = [rim[0], rim[1], rim[1], rim[2], rim[2], rim[3], rim[3], rim[0]];
    this.corners.x = [at(0, -b), at(0, b)];
    this.corners.y = [at(-a, 0), at(a, 0)];
    const bar = relief ? barFor(spanOf(relief.values)) : 0; // m
    this.corners.z = bar > 0 ? rim : [];
    lines.push(...this.corners.z.flatMap((corner) => [corner, corner.clone().setZ(corner.z + bar * up)]));
    const ends = new BufferGeometry().setFromPoints(lines);
    this.frame = new LineSegments(ends, new LineBasicMaterial({ color: this.ink }));
    this.scene.add(this.frame);
  }

  render({ turn, tilt, zoom }: Attitude): void {
    const [t, p] = [(turn * Math.PI) / 180, (tilt * Math.PI) / 180];
    // Fits the tile's diagonal.
    const distance = (3.0 / zoom) * Math.max(1, 1.15 / this.camera.aspect);
    this.camera.position
      .set(Math.sin(t) * Math.cos(p), -Math.cos(t) * Math.cos(p), Math.sin(p))
      .multiplyScalar(distance);
    this.camera.lookAt(0, 0, 0);
    this.renderer.render(this.scene, this.camera);
  }

  /** At the edges nearest to the viewer. */
  anchors(width: number, height: number): Anchor[] {
    this.camera.updateMatrixWorld();
    const seen = (v: Vector3): { left: number; top: number; depth: number } => {
      const p = v.clone().project(this.camera);
      return {
        left: ((p.x + 1) / 2) * width,
        top: ((1 - p.y) / 2) * height,
        depth: v.distanceTo(this.camera.position),
      };
    };
    const result: Anchor[] = [];
    for (const name of ['x', 'y', 'z'] as const) {
      const places = this.corners[name].map(seen);
      if (places.length === 0) continue;
      // Scale label: left, in front of the background.
      const best = places.reduce((p, q) => (name === 'z' ? (q.left < p.left ? q : p) : q.depth < p.depth ? q : p));
      result.push({ name, left: best.left, top: best.top, outward: best.left < width / 2 ? -1 : 1 });
    }
    return result;
  }

  dispose(): void {
    this.clear();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  private clear(): void {
    for (const thing of [this.mesh, this.frame]) {
      if (!thing) continue;
      this.scene.remove(thing);
      thing.geometry.dispose();
      thing.material.dispose();
    }
    this.mesh = undefined;
    this.frame = undefined;
  }
}

/** Mostly ambient light, with a part from the north-west. */
function shaded(
  colours: Uint8Array,
  z: Float32Array,
  known: (k: number) => boolean,
  nx: number,
  ny: number,
  width: number,
  depth: number,
): Uint8Array {
  const out = new Uint8Array(colours.length);
  const [dx, dy] = [width / Math.max(1, nx - 1), depth / Math.max(1, ny - 1)];
  const light = [-0.5, 0.5, 0.7071];
  for (let j = 0, k = 0; j < ny; ++j) {
    for (let i = 0; i < nx; ++i, ++k) {
      const [l, r] = [i > 0 && known(k - 1) ? 1 : 0, i + 1 < nx && known(k + 1) ? 1 : 0];
      const [d, u] = [j > 0 && known(k - nx) ? nx : 0, j + 1 < ny && known(k + nx) ? nx : 0];
      const sx = l + r ? (z[k + r] - z[k - l]) / ((l + r) * dx) : 0;
      const sy = d + u ? (z[k + u] - z[k - d]) / (((d + u) / nx) * dy) : 0;
      const dot = (-sx * light[0] - sy * light[1] + light[2]) / Math.sqrt(sx * sx + sy * sy + 1);
      const factor = Math.min(1, 0.62 + 0.54 * Math.max(0, dot));
      for (let c = 0; c < 3; ++c) out[3 * k + c] = colours[3 * k + c] * factor;
    }
  }
  return out;
}
