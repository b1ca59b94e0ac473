// SPDX-License-Identifier: MIT
// node three_test.mjs SOURCE.glb BAKED.glb [SOURCE BAKED ...]: what three.js's GLTFLoader makes of a
// baked file is what it makes of the source: the same nodes, meshes, triangles, materials and boxes.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import process from 'node:process';
import { pathToFileURL } from 'node:url';

// The packages live beside the other judges, not beside this file.
const require = createRequire(new URL('../tools/package.json', import.meta.url));
const load = (path) => import(new URL(path, pathToFileURL(require.resolve('three'))).href);
globalThis.self = globalThis;  // the loader looks there for URL and timers
const THREE = await load('three.module.js');
const { GLTFLoader } = await load('../examples/jsm/loaders/GLTFLoader.js');

// Pictures need a browser to decode; their bytes are compared in the documents instead.
const withoutPictures = () => ({ name: 'no_pictures', loadTexture: async () => new THREE.Texture() });

async function open(file) {
    const bytes = readFileSync(file);
    const loader = new GLTFLoader();
    loader.register(withoutPictures);
    return loader.parseAsync(
        bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength), '');
}

function hash(array) {  // FNV-1a over the bytes
    let h = 0x811c9dc5;
    for (const b of new Uint8Array(array.buffer, array.byteOffset, array.byteLength))
        h = Math.imul(h ^ b, 0x01000193) >>> 0;
    return h;
}

function describe(gltf) {
    const nodes = [];
    gltf.scene.updateMatrixWorld(true);
    gltf.scene.traverse((object) => {
        const node = { name: object.name, type: object.type, matrix: object.matrixWorld.toArray() };
        if (object.isMesh) {
            const { attributes, index } = object.geometry;
            node.triangles = (index ?? attributes.position).count / 3;
            node.vertices = attributes.position.count;
            node.material = object.material.name;
            node.attributes = Object.fromEntries(
                Object.entries(attributes).map(([name, a]) => [name, hash(a.array ?? a.data.array)]));
        }
        nodes.push(node);
    });
    const box = new THREE.Box3().setFromObject(gltf.scene);
    return { scenes: gltf.scenes.length, nodes, box: [box.min.toArray(), box.max.toArray()] };
}

const files = process.argv.slice(2);
assert.ok(files.length >= 2 && files.length % 2 === 0, 'usage: three_test.mjs SOURCE BAKED ...');
for (let i = 0; i < files.length; i += 2) {
    const [source, baked] = await Promise.all([open(files[i]), open(files[i + 1])]);
    const expected = describe(source);
    assert.ok(expected.nodes.some((n) => n.triangles > 0), `${files[i]} shows no triangle`);
    assert.ok(baked.parser.json.extensionsUsed.includes('SHERD_mesh_fracture'), 'not baked');
    assert.deepEqual(describe(baked), expected);
    const meshes = expected.nodes.filter((n) => n.triangles > 0);
    console.log(`${files[i + 1]}: three.js ${THREE.REVISION} shows ${meshes.length} meshes, ` +
        `${meshes.reduce((sum, n) => sum + n.triangles, 0)} triangles, ` +
        `${expected.nodes.length} objects, as in the source`);
}
