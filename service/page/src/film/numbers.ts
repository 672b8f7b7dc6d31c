/** Numbers as the page writes them: with as many digits as say something, and their unit. */

/** A share as percent: 0.1234 is "12.3 %". */
export function percent(share: number): string {
  return `${decimals(100 * share)} %`;
}

/** Three significant digits, as a plain decimal. */
export function decimals(value: number): string {
  const size = Math.abs(value);
  if (size >= 99.95) return value.toFixed(0);
  if (size >= 9.995) return value.toFixed(1);
  if (size >= 0.9995 || size === 0) return value.toFixed(size === 0 ? 0 : 2);
  if (size < 1e-4) return value.toExponential(1).replace("e-", " × 10^-");
  return String(Number(value.toPrecision(2)));
}

export function degrees(theta: number): string {
  return `${Math.round(theta * 10) / 10}°`;
}

/** "normal incidence", or "45°". */
export function incidence(thetaDegrees: number): string {
  return thetaDegrees === 0 ? "normal incidence" : degrees(thetaDegrees);
}

export function nanometres(nm: number): string {
  return `${Number(nm.toFixed(1))} nm`;
}

/** Bytes as people count them: 148460 is "148 kB". */
export function bytes(count: number): string {
  if (count < 1000) return `${count} B`;
  if (count < 999_500) return `${decimals(count / 1000)} kB`;
  return `${decimals(count / 1e6)} MB`;
}

export function counted(value: number): string {
  return value.toLocaleString("en-GB");
}
