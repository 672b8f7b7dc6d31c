/** A group of layers that is repeated. */

import { LayerRow } from "./layer-row";
import { NumberField } from "./number-field";
import { RowActions } from "./row-actions";
import { focusRow, stackNews } from "./row-focus";
import { moveEntry, removeEntry, setRepeat, ungroup } from "../film/document";
import type { Group } from "../service/answers";
import { edit } from "../state/editor";

interface GroupRowProps {
  readonly group: Group;
  readonly at: number;
  readonly isFirst: boolean;
  readonly isLast: boolean;
}

export function GroupRow({ group, at, isFirst, isLast }: GroupRowProps) {
  const name = `group ${at + 1}`;
  const path = `stack.layers.${at}.repeat`;
  const isAlone = group.layers.length === 1;
  return (
    <li class="group-row" data-row={at} aria-label={`Group ${at + 1}`}>
      <div class="group-head">
        <div class="group-count">
          <NumberField
            label={`Repeat ${name}`}
            labelled="unseen"
            value={group.repeat}
            unit={`× ${group.layers.length === 1 ? "this layer" : `these ${group.layers.length} layers`}`}
            expected="how often, a whole number from 1 to 1000000"
            step={1}
            path={path}
            onValue={(value) => edit(setRepeat(at, value), path)}
          />
        </div>
        <button type="button" onClick={() => edit(ungroup(at))}>Ungroup</button>
        <RowActions
          name={name}
          isFirst={isFirst}
          isLast={isLast}
          onMove={(by) => moveGroup(at, by)}
          onRemove={() => removeGroup(at)}
        />
      </div>
      <ol>
        {group.layers.map((layer, member) => (
          <LayerRow
            key={member}
            layer={layer}
            place={{ entry: at, member }}
            isFirst={isAlone}
            isLast={isAlone}
          />
        ))}
      </ol>
    </li>
  );
}

function moveGroup(at: number, by: -1 | 1): void {
  edit(moveEntry(at, at + by));
  stackNews.value = `Group ${at + 1} moved ${by < 0 ? "up" : "down"}.`;
  focusRow({ entry: at + by }, by < 0 ? "up" : "down");
}

function removeGroup(at: number): void {
  edit(removeEntry(at));
  stackNews.value = `Group ${at + 1} removed.`;
  focusRow({ entry: at }, "remove");
}
