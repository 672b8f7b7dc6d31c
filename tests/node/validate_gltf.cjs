// Prints the report of Khronos's glTF validator on a file, as JSON.
const { readFile } = require("node:fs/promises");
const validator = require("gltf-validator");

async function main(path) {
  const report = await validator.validateBytes(new Uint8Array(await readFile(path)));
  process.stdout.write(JSON.stringify(report));
}

main(process.argv[2]);
