/** The bearer key of a service that asks for one: kept for this tab alone. */

import { signal } from "@preact/signals";

const STORED = "nacreous:key";

export const key = signal(sessionStorage.getItem(STORED) ?? "");

/** Whether the service has asked for a key, or for another one. */
export const keyWanted = signal(false);

export function useKey(value: string): void {
  key.value = value;
  keyWanted.value = false;
  sessionStorage.setItem(STORED, value);
}

/** The service refuses a key: whether that is the one in use, and another is wanted. */
export function refuseKey(used: string): boolean {
  const isCurrent = used === key.value;
  if (isCurrent) keyWanted.value = true;
  return isCurrent;
}

/** The header of a request. */
export function bearerKey(): Record<string, string> {
  return key.value ? { Authorization: `Bearer ${key.value}` } : {};
}
