/** What a layer or a half-space consists of: a material of the library, n + ik, or what the spec has brought along. */

import { useId, useState } from "preact/hooks";

import { FieldMessage, refusalWords } from "./field-message";
import { MaterialCombobox } from "./material-combobox";
import { NumberField } from "./number-field";
import type { Material } from "../film/document";
import { described, held, isHeld, kindOf, nameOf } from "../film/material";
import { quoted } from "../film/typed";
import type { ConstantMaterial } from "../service/answers";
import { problemAt } from "../state/problems";
import "./material-field.css";

const STEP = 0.01;
const FIRST_CONSTANT: ConstantMaterial = { n: 1.5 };

interface MaterialFieldProps {
  readonly label: string;
  readonly path: string;
  readonly material: Material;
  /** Changes of one gesture are taken back together. */
  readonly onMaterial: (material: Material, gesture?: string) => void;
}

export function MaterialField(props: MaterialFieldProps) {
  const { material, onMaterial } = props;
  const [replaced, setReplaced] = useState<Material>();
  const kind = kindOf(material);
  if (kind === "named" || replaced === material) {
    const back = kind === "named" ? undefined : () => setReplaced(undefined);
    return <NamedField {...props} isReplacing={back !== undefined} onBack={back} />;
  }
  const replace = () => setReplaced(material);
  if (kind === "constant") return <ConstantField {...props} constant={material as ConstantMaterial} onReplace={replace} />;
  return <GivenField {...props} onReplace={replace} onConstant={() => onMaterial(FIRST_CONSTANT)} />;
}

interface NamedFieldProps extends MaterialFieldProps {
  readonly isReplacing: boolean;
  readonly onBack: (() => void) | undefined;
}

function NamedField({ label, path, material, onMaterial, isReplacing, onBack }: NamedFieldProps) {
  const id = useId();
  const [unknown, setUnknown] = useState("");
  const problem = isReplacing ? undefined : problemAt(path);
  const message = unknown ? `Expected a material of the library, got ${quoted(unknown)}; choose one of the list.` : refusalWords(problem);
  const isBeyond = !unknown && problem?.expected?.startsWith("wavelengths within the data") && !isHeld(material);
  return (
    <div class="material-field">
      <MaterialCombobox
        label={label}
        name={isReplacing ? "" : nameOf(material)}
        messageId={id}
        message={message}
        {...(isReplacing ? { focused: "at once" as const } : {})}
        onChoose={(name) => onMaterial(name)}
        onUnknown={setUnknown}
      />
      {onBack ? (
        <button type="button" onClick={onBack} aria-label={`${label}: keep ${described(material)}`}>Keep</button>
      ) : (
        <button type="button" onClick={() => onMaterial(FIRST_CONSTANT)} aria-label={`${label}: give n, k`} title="Give n and k">
          n, k
        </button>
      )}
      {isHeld(material) && <span class="quiet">Held beyond its data</span>}
      <FieldMessage id={id} message={message}>
        {isBeyond && (
          <button type="button" onClick={() => onMaterial(held(material))}>
            Hold beyond its data
          </button>
        )}
      </FieldMessage>
    </div>
  );
}

interface ReplacedProps extends MaterialFieldProps {
  readonly onReplace: () => void;
}

function ConstantField({ label, path, constant, onMaterial, onReplace }: ReplacedProps & { readonly constant: ConstantMaterial }) {
  const { n, k = 0 } = constant;
  return (
    <div class="material-field" role="group" aria-label={label}>
      <NumberField
        label="n"
        value={n}
        expected="a refractive index, 0.001 to 1000"
        step={STEP}
        path={`${path}.n`}
        onValue={(value) => onMaterial({ ...constant, n: value }, `${path}.n`)}
      />
      <NumberField
        label="k"
        value={k}
        expected="an extinction coefficient, 0 to 1000"
        step={STEP}
        path={`${path}.k`}
        onValue={(value) => onMaterial({ ...constant, k: value }, `${path}.k`)}
      />
      <button type="button" onClick={onReplace} aria-label={`${label}: choose from the library`}>Library</button>
      <WholeMessage path={path} />
    </div>
  );
}

/** A refusal of the material as a whole, such as of an incident medium that absorbs. */
function WholeMessage({ path }: { readonly path: string }) {
  const problem = problemAt(path);
  return <FieldMessage id={useId()} message={problem?.field === path ? refusalWords(problem) : undefined} />;
}

function GivenField({ label, path, material, onReplace, onConstant }: ReplacedProps & { readonly onConstant: () => void }) {
  return (
    <div class="material-field" role="group" aria-label={label}>
      <span class="given">{described(material)}</span>
      <button type="button" onClick={onReplace} aria-label={`${label}: choose from the library`}>Library</button>
      <button type="button" onClick={onConstant} aria-label={`${label}: give n, k`}>n, k</button>
      <FieldMessage id={useId()} message={refusalWords(problemAt(path))} />
    </div>
  );
}
