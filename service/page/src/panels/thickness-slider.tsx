/** A thickness by hand: from nothing to about twice what it is, where the colours follow each other evenly. */

import { useState } from "preact/hooks";

import { nanometres } from "../film/numbers";
import { endGesture } from "../state/editor";

const WIDE = 10;
const LEAST_END_NM = 20;
/** Of the slider's length: beyond these its end is moved, once it rests. */
const NEAR_END = 0.95;
const NEAR_START = 0.12;

interface ThicknessSliderProps {
  readonly label: string;
  readonly value: number;
  readonly onValue: (value: number) => void;
}

export function ThicknessSlider({ label, value, onValue }: ThicknessSliderProps) {
  const [end, setEnd] = useState(() => endFor(value));
  const [isHeld, setIsHeld] = useState(false);
  const share = value / end;
  const shown = isHeld || (share <= NEAR_END && share >= NEAR_START) ? end : endFor(value);
  if (shown !== end) setEnd(shown);
  const step = shown <= 100 ? 0.1 : shown <= 5000 ? 1 : shown / 5000;
  const rest = () => {
    setIsHeld(false);
    endGesture();
  };
  return (
    <input
      class="thickness-slider"
      type="range"
      aria-label={label}
      aria-valuetext={nanometres(value)}
      min="0"
      max={shown}
      step={step}
      value={value}
      onInput={({ currentTarget }) => onValue(Number(currentTarget.value))}
      onPointerDown={() => setIsHeld(true)}
      onPointerUp={rest}
      onPointerCancel={rest}
      onBlur={rest}
      onKeyDown={(event) => {
        const direction = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1 }[event.key];
        if (direction === undefined || !event.shiftKey) return;
        event.preventDefault();
        onValue(Math.min(Math.max(Math.round((value + direction * WIDE * step) * 10) / 10, 0), shown));
      }}
    />
  );
}

/** The first of 20, 50, 100, 200 ... that is at least twice the value. */
function endFor(value: number): number {
  const least = Math.max(2 * value, LEAST_END_NM);
  const power = 10 ** Math.floor(Math.log10(least));
  return power * ([1, 2, 5, 10].find((digit) => digit * power >= least) ?? 10);
}
