/** The page's tokens and its font, for what is drawn by script and not by a style sheet. */

/** Never seen: a colour of the page, which may be one of two, becomes that of the theme as an element's own. */
const probe = document.documentElement.appendChild(document.createElement("span"));
probe.hidden = true;

/** The colour of a token, such as --ink, in the theme that the page is in. */
export function token(name: `--${string}`): string {
  probe.style.color = `var(${name})`;
  return getComputedStyle(probe).color;
}

/** A font for drawings: the page's own, small. */
export function plotFont(): string {
  return `12px ${getComputedStyle(document.body).fontFamily}`;
}
