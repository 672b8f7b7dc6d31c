/** Small drawings on buttons; the button says in words what it does. */

const PATHS = {
  undo: "M6 3 2.5 6.5 6 10 M3 6.5h6.5a4 4 0 0 1 0 8H7",
  redo: "M10 3l3.5 3.5L10 10 M13 6.5H6.5a4 4 0 0 0 0 8H9",
  up: "M8 13V3.5 M4 7l4-4 4 4",
  down: "M8 3v9.5 M4 9l4 4 4-4",
  remove: "M4 4l8 8 M12 4l-8 8",
  add: "M8 3v10 M3 8h10",
} as const;

export function Icon({ name }: { readonly name: keyof typeof PATHS }) {
  return (
    <svg class="icon-drawing" viewBox="0 0 16 16" width="16" height="16" aria-hidden="true">
      <path d={PATHS[name]} fill="none" stroke="currentColor" stroke-width="1.5" stroke-linecap="round" stroke-linejoin="round" />
    </svg>
  );
}
