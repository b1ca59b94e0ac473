// SPDX-License-Identifier: MIT
// Cuts what `sherd_bench_volume --export FOLDER` wrote with other people's programs.
//
// usage: node peers.mjs FOLDER [RUNS]
//
// Milliseconds are CPU time of the whole process, the smallest of RUNS (1) runs; loading and
// checking are not counted. A piece is closed if over bit-equal positions every directed edge of its
// triangles is used as often as its reverse: the same proof as ours.
import fs from 'node:fs';
import path from 'node:path';
import * as THREE from 'three';
import {DestructibleMesh, FractureOptions} from '@dgreenheck/three-pinata';
import Module from 'manifold-3d';

const wasm = await Module();
wasm.setup();

// A piece as plain arrays: xyz per vertex, three vertices a triangle.
const piece = (positions, triangles) => ({positions, triangles});

function pinata(input) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(input.positions), 3));
  geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(input.triangles), 1));
  geometry.computeVertexNormals();
  geometry.setAttribute(
      'uv', new THREE.BufferAttribute(new Float32Array(input.positions.length / 3 * 2), 2));
  const mesh = new DestructibleMesh(geometry, new THREE.MeshBasicMaterial());
  const seeds = [];
  for (let i = 0; i < input.sites.length; i += 3)
    seeds.push(new THREE.Vector3(...input.sites.slice(i, i + 3)));
  const options = new FractureOptions({
    fractureMethod: 'voronoi', fragmentCount: seeds.length, seed: 1,
    voronoiOptions: {mode: '3D', seedPoints: seeds, useApproximation: false}
  });
  return () => mesh.fracture(options).map(fragment => {
    // Each fragment is moved to its own middle; back to where it was cut, in doubles.
    const p = Float64Array.from(fragment.geometry.getAttribute('position').array);
    const index = fragment.geometry.getIndex();
    return piece(p, index ? index.array : Uint32Array.from({length: p.length / 3}, (_, i) => i));
  });
}

// Each cell trimmed out of a box, nearest sites first until none can reach it, then intersected
// with the mesh: one boolean operation a cell.
function manifold(input) {
  const {Manifold, Mesh} = wasm;
  const sites = [];
  for (let i = 0; i < input.sites.length; i += 3) sites.push(input.sites.slice(i, i + 3));
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  input.positions.forEach((x, i) => {
    low[i % 3] = Math.min(low[i % 3], x);
    high[i % 3] = Math.max(high[i % 3], x);
  });
  const size = high.map((h, k) => 1.1 * (h - low[k]));
  const middle = high.map((h, k) => (h + low[k]) / 2);
  const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  const reach = (cell, site) => {
    const {vertProperties: p, numProp: n} = cell.getMesh();
    let far = 0;
    for (let v = 0; v < p.length; v += n) far = Math.max(far, distance(p.slice(v, v + 3), site));
    return far;
  };
  return () => {
    const whole = Manifold.ofMesh(new Mesh({
      numProp: 3, vertProperties: new Float32Array(input.positions),
      triVerts: new Uint32Array(input.triangles)
    }));
    const pieces = [];
    for (const site of sites) {
      let cell = Manifold.cube(size, true).translate(middle);
      let radius = reach(cell, site);
      const others = sites.filter(s => s !== site).map(s => [distance(s, site), s]);
      others.sort((a, b) => a[0] - b[0]);
      for (const [d, other] of others) {
        if (d > 2 * radius) break;
        const normal = site.map((x, k) => (x - other[k]) / d);
        const offset = normal.reduce((sum, n, k) => sum + n * (site[k] + other[k]) / 2, 0);
        const cut = cell.trimByPlane(normal, offset);
        cell.delete();
        cell = cut;
        radius = reach(cell, site);
      }
      const part = whole.intersect(cell);
      cell.delete();
      if (!part.isEmpty()) {
        const mesh = part.getMesh();
        const count = mesh.vertProperties.length / mesh.numProp;
        const positions = new Float64Array(3 * count);
        for (let v = 0; v < count; ++v)
          for (let k = 0; k < 3; ++k) positions[3 * v + k] = mesh.vertProperties[v * mesh.numProp + k];
        // What it says of vertices to be merged counts for it.
        const stands = Uint32Array.from({length: count}, (_, v) => v);
        (mesh.mergeFromVert ?? []).forEach((from, m) => { stands[from] = mesh.mergeToVert[m]; });
        pieces.push(piece(positions, mesh.triVerts.map(v => stands[v])));
      }
      part.delete();
    }
    whole.delete();
    return pieces;
  };
}

function volume({positions: p, triangles}) {
  let six = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [triangles[t], triangles[t + 1], triangles[t + 2]].map(v => 3 * v);
    six += p[a] * (p[b + 1] * p[c + 2] - p[b + 2] * p[c + 1]) +
        p[a + 1] * (p[b + 2] * p[c] - p[b] * p[c + 2]) + p[a + 2] * (p[b] * p[c + 1] - p[b + 1] * p[c]);
  }
  return six / 6;
}

function closed({positions, triangles}) {
  const ids = new Map();
  const idOf = Uint32Array.from({length: positions.length / 3}, (_, v) => {
    const key = [0, 1, 2].map(k => positions[3 * v + k] + 0).join();
    if (!ids.has(key)) ids.set(key, ids.size);
    return ids.get(key);
  });
  const edges = new Map();
  for (let t = 0; t < triangles.length; t += 3) {
    const v = [0, 1, 2].map(k => idOf[triangles[t + k]]);
    if (v[0] === v[1] || v[1] === v[2] || v[2] === v[0]) continue;
    for (let k = 0; k < 3; ++k) {
      const a = v[k], b = v[(k + 1) % 3];
      const key = Math.min(a, b) * 2 ** 26 + Math.max(a, b);
      edges.set(key, (edges.get(key) ?? 0) + (a < b ? 1 : -1));
    }
  }
  for (const sum of edges.values())
    if (sum !== 0) return false;
  return true;
}

const cpu = () => {
  const {user, system} = process.cpuUsage();
  return (user + system) / 1000;
};

const [folder, runs = '1'] = process.argv.slice(2);
const peers = {'three-pinata 2.0.1': pinata, 'manifold-3d 3.5.4': manifold};
console.log(`${'peer'.padEnd(20)}${'model'.padEnd(16)}${'triangles'.padStart(10)}${'cells'.padStart(7)}` +
    `${'pieces'.padStart(8)}${'closed'.padStart(8)}${'after'.padStart(10)}${'volume off'.padStart(12)}${'all'.padStart(10)}`);
const files = fs.readdirSync(folder).filter(f => f.endsWith('.json'));
files.sort((a, b) => a.localeCompare(b, 'en', {numeric: true}));
for (const file of files) {
  const input = JSON.parse(fs.readFileSync(path.join(folder, file)));
  const whole = volume({positions: input.positions, triangles: input.triangles});
  for (const [name, prepare] of Object.entries(peers)) {
    const row = `${name.padEnd(20)}${input.name.padEnd(16)}` +
        `${String(input.triangles.length / 3).padStart(10)}${String(input.sites.length / 3).padStart(7)}`;
    try {
      let best = Infinity, pieces = [];
      for (let run = 0; run < Number(runs); ++run) {
        const cut = prepare(input);
        const start = cpu();
        pieces = cut();
        best = Math.min(best, cpu() - start);
      }
      const sum = pieces.reduce((s, p) => s + volume(p), 0);
      const after = pieces.reduce((s, p) => s + p.triangles.length / 3, 0);
      console.log(`${row}${String(pieces.length).padStart(8)}${String(pieces.filter(closed).length).padStart(8)}` +
          `${String(after).padStart(10)}${(sum / whole - 1).toExponential(1).padStart(12)}${best.toFixed(0).padStart(10)}`);
    } catch (error) {
      console.log(`${row}  failed: ${error.message ?? error}`);
    }
  }
}
