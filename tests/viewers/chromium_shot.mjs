// SPDX-License-Identifier: MIT
// node chromium_shot.mjs CHROMIUM OUT_DIR SOURCE.glb BAKED.glb [...]: three.js draws both in a headless
// browser, from four sides, and the pictures are the same but for at most 0.1 % of the pixels.
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { basename, dirname, join } from 'node:path';
import process from 'node:process';
import { pathToFileURL } from 'node:url';

const require = createRequire(new URL('../tools/package.json', import.meta.url));
const { chromium } = (await import(pathToFileURL(require.resolve('playwright-core')).href)).default;
const three = dirname(dirname(require.resolve('three')));  // .../three/build/three.cjs
const SITE = 'http://viewer.test/';
const WIDTH = 512, HEIGHT = 512, VIEWS = 4;

const [browserPath, outDir, ...files] = process.argv.slice(2);
assert.ok(files.length >= 2 && files.length % 2 === 0,
    'usage: chromium_shot.mjs CHROMIUM OUT_DIR SOURCE BAKED ...');

const page_html = `<!doctype html><script type="importmap">
{"imports": {"three": "${SITE}three/build/three.module.js", "three/addons/": "${SITE}three/examples/jsm/"}}
</script><script type="module">
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
renderer.setSize(${WIDTH}, ${HEIGHT}, false);
document.body.append(renderer.domElement);
window.draw = async (url) => {
    const { scene } = await new GLTFLoader().loadAsync(url);
    scene.add(new THREE.HemisphereLight(0xffffff, 0x404060, 2));
    const sun = new THREE.DirectionalLight(0xffffff, 2);
    sun.position.set(1, 2, 3);
    scene.add(sun);
    const box = new THREE.Box3().setFromObject(scene);
    const centre = box.getCenter(new THREE.Vector3()), size = box.getSize(new THREE.Vector3()).length();
    const camera = new THREE.PerspectiveCamera(40, ${WIDTH / HEIGHT}, size / 100, size * 10);
    const gl = renderer.getContext(), views = [];
    for (let k = 0; k < ${VIEWS}; ++k) {
        const angle = 0.4 + k * 2 * Math.PI / ${VIEWS};
        camera.position.set(Math.sin(angle), 0.5, Math.cos(angle)).multiplyScalar(1.35 * size).add(centre);
        camera.lookAt(centre);
        renderer.render(scene, camera);
        const pixels = new Uint8Array(4 * ${WIDTH * HEIGHT});
        gl.readPixels(0, 0, ${WIDTH}, ${HEIGHT}, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        views.push({ pixels, picture: renderer.domElement.toDataURL('image/png') });
    }
    return { views, triangles: renderer.info.render.triangles };
};
window.compare = async (source, baked) => {
    const a = await draw(source), b = await draw(baked);
    return a.views.map((view, k) => {
        let different = 0, covered = 0;
        for (let i = 0; i < view.pixels.length; i += 4) {
            const at = (p) => (p[i] << 16) | (p[i + 1] << 8) | p[i + 2];
            covered += at(view.pixels) !== 0;
            different += at(view.pixels) !== at(b.views[k].pixels);
        }
        return { different, covered, triangles: [a.triangles, b.triangles],
                 pictures: [view.picture, b.views[k].picture] };
    });
};
window.ready = true;
</script>`;

const types = { '.js': 'text/javascript', '.glb': 'model/gltf-binary' };
async function serve(route) {
    const path = new URL(route.request().url()).pathname.slice(1);
    if (path === '') return route.fulfill({ contentType: 'text/html', body: page_html });
    const local = path.startsWith('three/') ? join(three, path.slice(6))
        : path.startsWith('model/') ? files[Number(path.slice(6))] : null;
    if (!local) return route.fulfill({ status: 404 });
    const extension = local.slice(local.lastIndexOf('.'));
    return route.fulfill({ contentType: types[extension] ?? 'application/octet-stream',
                           body: readFileSync(local) });
}

const browser = await chromium.launch({
    executablePath: browserPath,
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
        '--ignore-gpu-blocklist'],
});
try {
    const page = await browser.newPage();
    page.on('pageerror', (error) => console.error(String(error)));
    page.on('console', (message) => message.type() === 'error' && console.error(message.text()));
    await page.route('**/*', serve);
    await page.goto(SITE);
    await page.waitForFunction('window.ready === true');
    mkdirSync(outDir, { recursive: true });
    for (let i = 0; i < files.length; i += 2) {
        const views = await page.evaluate(`compare("${SITE}model/${i}", "${SITE}model/${i + 1}")`);
        let worst = 0, least = WIDTH * HEIGHT;
        for (const [k, view] of views.entries()) {
            view.pictures.forEach((url, which) => writeFileSync(
                join(outDir, `${basename(files[i + which], '.glb')}_${k}.png`),
                Buffer.from(url.slice(url.indexOf(',') + 1), 'base64')));
            worst = Math.max(worst, view.different);
            least = Math.min(least, view.covered);
            assert.equal(view.triangles[1], view.triangles[0], 'triangles drawn');
        }
        const all = WIDTH * HEIGHT;
        assert.ok(least > 0.02 * all, `${files[i]}: the picture is all but empty (${least} pixels)`);
        assert.ok(worst <= 0.001 * all, `${files[i + 1]}: ${worst} of ${all} pixels differ`);
        console.log(`${files[i + 1]}: ${VIEWS} views of ${all} pixels, at least ${least} covered, ` +
            `at most ${worst} differ from the source; ${views[0].triangles[1]} triangles drawn`);
    }
} finally {
    await browser.close();
}
