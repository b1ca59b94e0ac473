// SPDX-License-Identifier: MIT
// node validate_gltf.mjs FILE...: the Khronos validator's verdict. Any error or warning fails;
// information is shown, except what a private extension must cause.
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import process from 'node:process';
import validator from 'gltf-validator';

const expected = new Set(['UNSUPPORTED_EXTENSION', 'UNUSED_OBJECT']);
const severities = ['error', 'warning', 'information', 'hint'];
const files = process.argv.slice(2);
let failed = files.length === 0;
if (failed) console.error('usage: node validate_gltf.mjs FILE...');
for (const file of files) {
    const { issues } = await validator.validateBytes(new Uint8Array(readFileSync(file)), {
        uri: file,
        maxIssues: 0,
        externalResourceFunction: (uri) =>
            Promise.resolve(new Uint8Array(readFileSync(join(dirname(file), decodeURIComponent(uri))))),
    });
    const bad = issues.messages.filter((m) => m.severity < 2 || !expected.has(m.code));
    for (const m of bad.slice(0, 20))
        console.error(`${file}: ${severities[m.severity]} ${m.code}: ${m.message} [${m.pointer ?? ''}]`);
    console.log(`${file}: ${issues.numErrors} errors, ${issues.numWarnings} warnings`);
    if (issues.numErrors + issues.numWarnings > 0) failed = true;
}
process.exit(failed ? 1 : 0);
