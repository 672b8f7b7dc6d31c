/** The film to take away: its files for each program, and the spec to make them again. */

import { signal } from "@preact/signals";
import { useId } from "preact/hooks";

import { CopiedText } from "./copied-text";
import { FileRow } from "./file-row";
import { Recipe } from "./recipe";
import { Refusal } from "./refusal";
import { fileStem } from "../film/commands";
import { percent } from "../film/numbers";
import { type Target, TARGETS, wanting } from "../film/targets";
import type { TableAdded } from "../service/answers";
import { edit, openedPreset, spec } from "../state/editor";
import { isCurrent, makeFiles, making } from "../state/files";
import "./downloads.css";

/** Name of the target that the files are for; it stays while they are made anew. */
const chosen = signal(TARGETS[0]?.name);

export function Downloads() {
  const id = useId();
  const now = making.value;
  const isStale = now?.table !== undefined && !isCurrent.value;
  return (
    <section class="downloads" aria-labelledby={id}>
      <h2 id={id}>Take it away</h2>
      <p>
        <button type="button" class="primary" disabled={now?.pending && isCurrent.value} onClick={() => void makeFiles()}>
          {isStale ? "Make the files again" : "Make the files"}
        </button>
      </p>
      <div role="status">
        {now?.pending && <Progress fraction={now.job?.fraction} />}
        {isStale && <p>The film has changed since its files were made.</p>}
      </div>
      {now?.problem && isCurrent.value && <Refusal problem={now.problem} />}
      {now?.table && isCurrent.value && <Files table={now.table} />}
      <Recipe />
    </section>
  );
}

function Progress({ fraction }: { readonly fraction: number | undefined }) {
  return (
    <p>
      <progress aria-label="The table is being made" {...(fraction === undefined ? {} : { value: fraction })} />{" "}
      {fraction === undefined ? "The table is being made" : `This takes the service longer: ${percent(fraction)}`}
    </p>
  );
}

function Files({ table }: { readonly table: TableAdded }) {
  const name = useId();
  const target = TARGETS.find((each) => each.name === chosen.value);
  return (
    <>
      <fieldset class="targets">
        <legend>Where does it go?</legend>
        {TARGETS.map((each) => (
          <label key={each.name}>
            <input type="radio" name={name} checked={each.name === chosen.value} onChange={() => (chosen.value = each.name)} />
            <span>{each.name}</span>
          </label>
        ))}
      </fieldset>
      {target && <TargetFiles target={target} table={table} />}
      <p class="quiet">
        Table <code data-table={table.id}>{table.id}</code>
      </p>
    </>
  );
}

function TargetFiles({ target, table: { id, links } }: { readonly target: Target; readonly table: TableAdded }) {
  // A MaterialX document names its textures as the service does.
  const stem = target.formats.includes("materialx") ? id : fileStem(spec.value, openedPreset.value);
  const offered = target.formats.flatMap((format) => {
    const link = links[format];
    return link === undefined ? [] : [{ format, link, name: `${stem}${suffixOf(link)}` }];
  });
  const files = Object.fromEntries(offered.map(({ format, name }) => [format, name]));
  const isReadable = offered.length > 0 && (target.formats[0] !== "materialx" || "materialx" in files);
  if (!isReadable || (target.quantity && target.quantity !== (spec.value.table?.quantity ?? "fresnel"))) return <Wanting target={target} />;
  return (
    <>
      <p>{target.advice}</p>
      <ul class="files">
        {offered.map((each) => (
          <FileRow key={each.link} link={each.link} name={each.name} holds={HOLDS[each.format] ?? ""} />
        ))}
      </ul>
      {target.snippet && <CopiedText name={`snippet for ${target.name}`} text={target.snippet(files, spec.value)} />}
    </>
  );
}

function Wanting({ target }: { readonly target: Target }) {
  const { words, change } = wanting(target, spec.value);
  const make = () => {
    if (change) edit(change.make);
    void makeFiles();
  };
  return (
    <p class="wanting">
      {words} {change && <button type="button" onClick={make}>{change.name}</button>}
    </p>
  );
}

/** What a file holds, in a few words. */
const HOLDS: Readonly<Record<string, string>> = {
  exr: "lookup texture, linear colour, float32",
  "exr-transmission": "what is let through",
  "spectral-exr": "the spectra",
  "spectral-exr-transmission": "the spectra of what is let through",
  rgl: "measured material, spectra",
  "rgl-rgb": "measured material, RGB",
  mueller: "Mueller matrices, large",
  materialx: "the material",
  gltf: "the nearest film, on a sphere",
  netcdf: "every array, with units",
  npz: "every array",
  zarr: "every array, with units",
  csv: "one row a sample",
  png: "a picture to look at",
  merl: "as the MERL database has it",
  mbsdf: "for hosts of MDL",
};

function suffixOf(link: string): string {
  const name = link.slice(link.lastIndexOf("/") + 1);
  return name.slice(name.indexOf("."));
}
