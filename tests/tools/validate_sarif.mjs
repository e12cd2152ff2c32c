// The SARIF 2.1.0 schema of OASIS on one or more files: node validate_sarif.mjs LOG...
// Prints what is wrong. Exit status: 0 nothing, 1 something, 2 the schema is not there or a file cannot be read.
// POPUP_SARIF_SCHEMA names the directory where `npm install @microsoft/jest-sarif ajv@6` was run: the first has the
// schema, the second reads it.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { resolve } from 'node:path';

function compiled() {
  const directory = process.env.POPUP_SARIF_SCHEMA;
  try {
    const require = createRequire(directory ? resolve(directory, 'any.js') : import.meta.url);
    const Ajv = require('ajv');
    const ajv = new Ajv({ schemaId: 'id', meta: false, allErrors: true, unknownFormats: 'ignore', logger: false });
    // The schema is written in draft 4.
    ajv.addMetaSchema(require('ajv/lib/refs/json-schema-draft-04.json'));
    const name = '@microsoft/jest-sarif/lib/schemas/sarif-2.1.0-rtm.5.json';
    return ajv.compile(JSON.parse(readFileSync(require.resolve(name), 'utf8')));
  } catch (error) {
    console.error(`the schema is not there (${error.message}); POPUP_SARIF_SCHEMA must say where it was installed`);
    process.exit(2);
  }
}

const accepts = compiled();
let status = 0;
for (const file of process.argv.slice(2)) {
  let log;
  try {
    log = JSON.parse(readFileSync(file, 'utf8'));
  } catch (error) {
    console.error(`${file}: ${error.message}`);
    process.exit(2);
  }
  if (accepts(log)) continue;
  status = 1;
  for (const { dataPath, message } of accepts.errors) console.log(`${file}: ${dataPath}: ${message}`);
}
process.exit(status);
