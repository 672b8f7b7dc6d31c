/** How to make the same table again: the spec, the link, and two commands. */

import { CopiedText } from "./copied-text";
import { curlCommand, fileStem, tabulateCommand } from "../film/commands";
import { toToml } from "../film/toml";
import { key } from "../service/key";
import { openedPreset, spec } from "../state/editor";
import { permalink } from "../state/permalink";
import { saveFile } from "../state/taken-file";

export function Recipe() {
  const preset = openedPreset.value;
  const stem = fileStem(spec.value, preset);
  const toml = toToml(spec.value);
  const service = new URL(".", location.href).href;
  return (
    <div class="recipe">
      <details>
        <summary>Link to this film</summary>
        <CopiedText name="link" text={permalink.value} />
      </details>
      <details>
        <summary>Spec as TOML</summary>
        <CopiedText name="TOML" text={toml} />
        <button type="button" onClick={() => saveFile(new Blob([toml], { type: "application/toml" }), `${stem}.toml`)}>
          Save {stem}.toml
        </button>
      </details>
      <details>
        <summary>Command line</summary>
        {!preset && <p>With the spec saved as {stem}.toml:</p>}
        <CopiedText name="command" text={tabulateCommand(preset, stem)} />
      </details>
      <details>
        <summary>From this service, by curl</summary>
        <CopiedText name="curl command" text={curlCommand(spec.value, service, key.value !== "")} />
      </details>
    </div>
  );
}
