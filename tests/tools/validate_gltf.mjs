// Khronos's glTF validator on one or more files: node validate_gltf.mjs MODEL...
// Prints every message. Exit status: 0 no error and no warning, 1 some, 2 the validator is not there or a file cannot
// be read. POPUP_GLTF_VALIDATOR names the directory where `npm install gltf-validator` was run, or its node_modules.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { resolve } from 'node:path';

function validator() {
  const directory = process.env.POPUP_GLTF_VALIDATOR;
  const from = directory ? resolve(directory, 'any.js') : import.meta.url;
  try {
    return createRequire(from)('gltf-validator');
  } catch (error) {
    console.error(`gltf-validator is not there (${error.message}); POPUP_GLTF_VALIDATOR must say where it was installed`);
    process.exit(2);
  }
}

const { validateBytes } = validator();
const severities = ['error', 'warning', 'info', 'hint'];
let status = 0;
for (const file of process.argv.slice(2)) {
  let bytes;
  try {
    bytes = new Uint8Array(await readFile(file));
  } catch (error) {
    console.error(error.message);
    process.exit(2);
  }
  // A file that is no glTF at all makes the validator throw.
  const report = await validateBytes(bytes, { uri: file, maxIssues: 100 }).catch((error) => ({
    issues: { numErrors: 1, numWarnings: 0, messages: [{ severity: 0, code: 'NOT_GLTF', message: String(error) }] },
  }));
  const { numErrors, numWarnings, messages } = report.issues;
  for (const { severity, code, message, pointer } of messages) {
    console.log(`${file}: ${severities[severity]}: ${message} [${code}]${pointer ? ` at ${pointer}` : ''}`);
  }
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings`);
  if (numErrors + numWarnings > 0) status = 1;
}
process.exit(status);
