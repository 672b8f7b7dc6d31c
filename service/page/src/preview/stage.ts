/** The scene: a shape that wears the film, in its surroundings, seen by a camera. */

import { NacreousMaterial } from "@nacreous/three";
import { DoubleSide, FrontSide, Mesh, PerspectiveCamera, Scene, WebGLRenderer } from "three";

import { appearance, isBubble } from "./appearance";
import { backdrop, type Shadow, shadow } from "./backdrop";
import { environment } from "./environment";
import { finished } from "./finished";
import { NoWebGLError } from "./no-webgl";
import { type Films, forThisGpu, freeTextures } from "./textures";
import { Orbit } from "./orbit";
import { type Mood, Pace } from "./pace";
import { type ShapeModel, shapeModel } from "./shapes/shape";
import { setTone } from "./tone";
import type { Lookup } from "../state/lookup";
import type { Theme } from "../state/theme";
import type { Light, Shape } from "../state/view";

/** How a film is looked at. */
export interface View {
  readonly shape: Shape;
  readonly light: Light;
  readonly theme: Theme;
}

export class Stage {
  readonly #renderer: WebGLRenderer;
  readonly #scene = new Scene();
  readonly #orbit = new Orbit(new PerspectiveCamera(26, 1, 0.5, 20));
  readonly #pace = new Pace(
    (pixelRatio, mood) => this.#draw(pixelRatio, mood),
    (mood) => void (this.canvas.dataset.drawn = mood),
  );
  readonly #shadow: Shadow = shadow();
  #mesh: Mesh<ShapeModel["geometry"], NacreousMaterial> | undefined;
  #model: ShapeModel = shapeModel("sphere");
  #view: View | undefined;
  #lookup: Lookup | undefined;
  #films: Films | undefined;
  #size: readonly [number, number] = [1, 1];

  /** @throws Error if there is no WebGL 2. */
  constructor(readonly canvas: HTMLCanvasElement, readonly onDrawn: (drawn: Lookup) => void) {
    this.#renderer = new WebGLRenderer({ canvas, context: webgl(canvas) });
    setTone(this.#renderer);
    this.#scene.add(this.#shadow);
    canvas.addEventListener("webglcontextrestored", () => this.#relight());
  }

  turn(azimuthDegrees: number, elevationDegrees: number): void {
    this.#orbit.turn(azimuthDegrees, elevationDegrees);
    this.#pace.moving();
  }

  reset(): void {
    this.#orbit.reset();
    this.#pace.still();
  }

  /** Draw as many CSS pixels. */
  resize(width: number, height: number): void {
    this.#size = [width, height];
    this.#orbit.frame(width / height);
    this.#pace.still();
  }

  show(view: View): void {
    const before = this.#view;
    this.#view = view;
    if (before?.shape !== view.shape) this.#exchange(shapeModel(view.shape));
    if (before?.light !== view.light || before.theme !== view.theme) this.#relight();
    this.#pace.still();
  }

  /** Show a film. Only its textures change where it is of the kind of the last one. */
  wear(lookup: Lookup, kind: "coarse" | "fine"): void {
    const before = this.#films;
    this.#lookup = lookup;
    this.#films = forThisGpu(lookup, this.#renderer);
    this.#mesh ??= this.#firstMesh(this.#films);
    this.#dress();
    if (before) freeTextures(before);
    if (kind === "fine") this.#pace.still();
    else this.#pace.moving();
  }

  dispose(): void {
    this.#pace.stop();
    this.#mesh?.material.dispose();
    this.#renderer.dispose();
  }

  #firstMesh({ reflectance }: Films): Mesh<ShapeModel["geometry"], NacreousMaterial> {
    const mesh = new Mesh(this.#model.geometry, new NacreousMaterial({ film: reflectance }));
    this.#scene.add(mesh);
    return mesh;
  }

  #exchange(model: ShapeModel): void {
    for (const thing of this.#model.beside ?? []) this.#scene.remove(thing);
    for (const thing of model.beside ?? []) this.#scene.add(thing);
    this.#model = model;
    this.#shadow.position.y = model.shadow.y;
    this.#shadow.scale.setScalar(1.9 * model.shadow.radius);
    if (this.#mesh) this.#mesh.geometry = model.geometry;
    this.#dress();
  }

  /** A film between equal media is seen through on every shape, glass on a lens. */
  #isSeenThrough(): boolean {
    const lookup = this.#lookup;
    if (!lookup?.transmittance) return false;
    return isBubble(lookup.spec) || this.#model.glass !== undefined;
  }

  /** Put the film on the shape, and what the surface of the spec and the shape ask of the material beside it. */
  #dress(): void {
    if (!this.#mesh || !this.#lookup || !this.#films) return;
    const { material } = this.#mesh;
    const { reflectance, transmittance } = this.#films;
    material.setFilm(reflectance, this.#isSeenThrough() ? transmittance : undefined);
    const { ground, ...look } = appearance(this.#lookup.spec);
    const isThrough = this.#isSeenThrough();
    const isThin = isBubble(this.#lookup.spec);
    const glass = isThrough && !isThin ? this.#model.glass : undefined;
    material.setValues({
      ...look,
      metalness: ground > 0 ? 0 : 1,
      transmission: isThrough ? 1 : 0,
      ior: glass?.ior ?? 1,
      thickness: glass?.thickness ?? 0,
      side: (isThrough && isThin) || this.#model.isCard ? DoubleSide : FrontSide, // a bubble has a front and a back
    });
    material.color.setScalar(ground > 0 ? ground : 1);
    if (material.thicknessScaleMap !== this.#model.thickness) material.thicknessScaleMap = this.#model.thickness;
    material.thicknessScaleRange = this.#model.thicknessScaleRange ?? [1, 1];
    for (const thing of this.#model.beside ?? []) thing.visible = isThrough || !this.#model.glass;
    this.#shadow.material.uniforms.darkness!.value = isThrough ? 0.18 : 0.55;
  }

  #relight(): void {
    if (!this.#view) return;
    this.#scene.environment?.dispose();
    this.#scene.environment = environment(this.#renderer, this.#view.light);
    const { background } = this.#scene;
    if (background && "dispose" in background) background.dispose();
    this.#scene.background = backdrop(this.#view.theme, this.#view.light);
    this.#pace.still();
  }

  /** Only a lens shows fine lines: what else is seen through a film is soft, and costs most of a frame. */
  async #draw(pixelRatio: number, mood: Mood): Promise<void> {
    const [width, height] = this.#size;
    const drawn = this.#lookup;
    if (this.#renderer.getContext().isContextLost() || !drawn) return;
    if (this.#renderer.getPixelRatio() !== pixelRatio) this.#renderer.setPixelRatio(pixelRatio);
    this.#renderer.setSize(width, height, false);
    this.#renderer.transmissionResolutionScale = mood === "moving" ? 0.4 : (this.#model.glass ? 1 : 0.5);
    this.#renderer.render(this.#scene, this.#orbit.camera);
    await finished(this.#renderer.getContext() as WebGL2RenderingContext);
    this.canvas.dataset.camera = this.#orbit.facts;
    this.onDrawn(drawn);
  }
}

/** Asked for here, because three complains on the console where there is none. */
function webgl(canvas: HTMLCanvasElement): WebGL2RenderingContext {
  const context = canvas.getContext("webgl2", { antialias: true, alpha: false, powerPreference: "high-performance" });
  if (!context) throw new NoWebGLError();
  return context;
}
