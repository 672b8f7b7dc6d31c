/** The buttons of a row of the stack: up, down, away. */

import { Icon } from "./icon";
import type { RowAction } from "./row-focus";

interface RowActionsProps {
  /** What the row is, such as "layer 2". */
  readonly name: string;
  readonly isFirst: boolean;
  readonly isLast: boolean;
  readonly onMove: (by: -1 | 1) => void;
  readonly onRemove: () => void;
}

export function RowActions({ name, isFirst, isLast, onMove, onRemove }: RowActionsProps) {
  return (
    <span class="row-actions">
      <RowButton action="up" label={`Move ${name} up`} isDisabled={isFirst} onClick={() => onMove(-1)} />
      <RowButton action="down" label={`Move ${name} down`} isDisabled={isLast} onClick={() => onMove(1)} />
      <RowButton action="remove" label={`Remove ${name}`} isDisabled={false} onClick={onRemove} />
    </span>
  );
}

interface RowButtonProps {
  readonly action: RowAction;
  readonly label: string;
  readonly isDisabled: boolean;
  readonly onClick: () => void;
}

function RowButton({ action, label, isDisabled, onClick }: RowButtonProps) {
  return (
    <button type="button" class="icon" data-action={action} aria-label={label} title={label} disabled={isDisabled} onClick={onClick}>
      <Icon name={action} />
    </button>
  );
}
