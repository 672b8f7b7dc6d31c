/** There is nothing to draw with: a file of its own, so that it is known before three is loaded. */

export class NoWebGLError extends Error {
  override readonly name = "NoWebGLError";

  constructor() {
    super("This browser offers no WebGL 2, which the preview is drawn with.");
  }
}
