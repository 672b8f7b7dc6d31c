// Write the types of the spec and of the service's answers, from its OpenAPI document:
//
//     curl -s localhost:8000/openapi.json | node make_answers.mjs > src/service/answers.d.ts
import { readFileSync } from "node:fs";
import { compile } from "json-schema-to-typescript";

const NAMES = ["Spec", "TableAdded", "PresetAnswer", "PresetEntry", "MaterialAnswer", "MaterialList", "ProblemAnswer", "JobAccepted"];
const OPTIONS = {
  additionalProperties: false,
  bannerComment: "/* Made from the service's OpenAPI document by make_answers.mjs; tests/web/test_page.py compares them. */",
  ignoreMinAndMaxItems: true,
  style: { printWidth: 120 },
};

const document = readFileSync(0, "utf8").replaceAll("#/components/schemas/", "#/$defs/");
const { schemas } = JSON.parse(document, simplified).components;
const answers = { type: "object", $defs: schemas, properties: Object.fromEntries(NAMES.map(reference)) };
process.stdout.write(await compile(answers, "Answers", OPTIONS));

function reference(name) {
  return [name, { $ref: `#/$defs/${name}` }];
}

/** Schemas as the compiler knows them: named by their definition, described in a paragraph, tuples by `items`. */
function simplified(key, value) {
  if (key === "title" && typeof value === "string") return undefined;
  if (key === "description" && typeof value === "string") return value.split("\n\n")[0];
  if (value?.prefixItems) return { ...value, items: value.prefixItems, prefixItems: undefined };
  return value;
}
