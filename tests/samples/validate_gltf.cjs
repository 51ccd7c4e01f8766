// SPDX-License-Identifier: Apache-2.0
// node validate_gltf.cjs MODULES FILE_OR_FOLDER...: runs Khronos's gltf-validator (in MODULES/node_modules) on
// every .glb given. Prints one line a file and each error and warning; exits 1 if there is any, 77 (skipped)
// if the module is not there.
'use strict';

const fs = require('fs');
const path = require('path');

const [modules, ...inputs] = process.argv.slice(2);
let validator;
try {
    validator = require(path.resolve(modules, 'node_modules', 'gltf-validator'));
} catch {
    console.log(`skipped: gltf-validator is not in ${modules}/node_modules; run install_gltf_validator.sh`);
    process.exit(77);
}

function glbFiles(input) {
    if (!fs.statSync(input).isDirectory()) return [input];
    return fs.readdirSync(input).filter((name) => name.endsWith('.glb')).sort().map((name) => path.join(input, name));
}

async function main() {
    const severities = ['error', 'warning'];
    const files = inputs.flatMap(glbFiles);
    let found = 0;
    for (const file of files) {
        const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), { maxIssues: 100 });
        const { numErrors, numWarnings, numInfos, numHints, messages } = report.issues;
        console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos, ${numHints} hints; ` +
            `${report.info.totalVertexCount} vertices, ${report.info.totalTriangleCount} triangles`);
        for (const { severity, code, message, pointer } of messages)
            if (severity < severities.length) console.log(`  ${severities[severity]} ${code} ${pointer}: ${message}`);
        found += numErrors + numWarnings;
    }
    if (files.length === 0) console.log('no .glb file was given');
    process.exit(found === 0 && files.length > 0 ? 0 : 1);
}

main();
