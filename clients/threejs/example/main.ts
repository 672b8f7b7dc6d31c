/** Spheres of several films under one light. README.md says how to make the tables. */

import { LiveFilm, loadLookupTexture, NacreousMaterial, type NacreousMaterialParameters } from "@nacreous/three";
import { MathUtils, Mesh, NeutralToneMapping, PerspectiveCamera, Scene, SphereGeometry, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import { studioEnvironment, studioFloor } from "./studio";
import { dipped, drained, streaming, thicknessMap } from "./thickness-maps";

type Look = Omit<NacreousMaterialParameters, "film" | "transmittance">;

interface Exhibit {
  /** A preset of Nacreous, or the film that the shader computes. */
  readonly name: string;
  /** x and z on the floor, and the radius. */
  readonly place: readonly [number, number, number];
  /** How high the sphere floats above the floor. */
  readonly above?: number;
  readonly isTransparent?: true;
  readonly look: Look;
}

const EXHIBITS: readonly Exhibit[] = [
  { name: "anodised-titanium", place: [-3.5, 0.3, 1], look: over(dipped, [0.2, 2.0], 0.16) },
  { name: "morpho", place: [-1.15, 1.1, 1], look: { thicknessScale: 1.08, roughness: 0.22 } },
  { name: "nacre", place: [1.2, 1.1, 1], look: over(streaming, [0.85, 1.3], 0.3) },
  { name: "live", place: [3.5, 0.3, 1], look: { roughness: 0.08 } },
  { name: "oil-on-water", place: [-2.35, -2.2, 1], look: over(streaming, [0.25, 1.1], 0.02) },
  { name: "beetle", place: [2.4, -2.2, 1], look: { thicknessScale: 1.06, roughness: 0.24, clearcoat: 0.4 } },
  {
    name: "soap-bubble",
    place: [0.05, -1.7, 1.3],
    above: 0.75,
    isTransparent: true,
    look: over(drained, [0.04, 0.8], 0),
  },
];

const TITANIUM = { wavelengthNm: [380, 500, 600, 780], n: [1.5, 1.84, 2.05, 2.6], k: [2.1, 2.4, 2.7, 3.1] };
const live = new LiveFilm({ layers: [{ index: 2.4, thicknessNm: 142 }], substrate: TITANIUM });

function over(thickness: Parameters<typeof thicknessMap>[0], range: [number, number], roughness: number): Look {
  return { thicknessScaleMap: thicknessMap(thickness), thicknessScaleRange: range, roughness };
}

async function material({ name, isTransparent, look }: Exhibit): Promise<NacreousMaterial> {
  if (name === "live") return new NacreousMaterial({ film: live, ...look });
  const film = await loadLookupTexture(`tables/${name}.exr`);
  if (!isTransparent) return new NacreousMaterial({ film, ...look });
  const transmittance = await loadLookupTexture(`tables/${name}.transmission.exr`);
  return new NacreousMaterial({ film, transmittance, ...look });
}

async function exhibit(item: Exhibit): Promise<Mesh<SphereGeometry, NacreousMaterial>> {
  const [x, z, radius] = item.place;
  const sphere = new Mesh(new SphereGeometry(radius, 128, 64), await material(item));
  sphere.position.set(x, radius + (item.above ?? 0), z);
  return sphere;
}

function element<E extends HTMLElement>(id: string): E {
  return document.getElementById(id) as E;
}

/** Call `show` with the value of a slider, now and whenever it moves. */
function onSlide(id: string, show: (value: number) => string): void {
  const slider = element<HTMLInputElement>(id);
  const update = () => { element(`${id}-shown`).textContent = show(slider.valueAsNumber); };
  slider.addEventListener("input", update);
  update();
}

function lens(renderer: WebGLRenderer, camera: PerspectiveCamera): void {
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
  const acrossAllSpheres = 2 * Math.atan(0.4 / camera.aspect);
  camera.fov = Math.max(24, MathUtils.radToDeg(acrossAllSpheres));
  camera.updateProjectionMatrix();
}

async function main(): Promise<void> {
  const renderer = new WebGLRenderer({ canvas: element("view"), antialias: true });
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  renderer.toneMapping = NeutralToneMapping;
  const scene = new Scene();
  scene.environment = studioEnvironment(renderer);
  const spheres = await Promise.all(EXHIBITS.map(exhibit));
  scene.add(studioFloor(EXHIBITS.map(({ place }) => place)), ...spheres);
  const camera = new PerspectiveCamera(24, 1, 0.1, 100);
  camera.position.set(0, 4.4, 13.2);
  const controls = new OrbitControls(camera, renderer.domElement);
  controls.target.set(0, 1.2, 0);
  controls.maxPolarAngle = 1.55;
  const draw = () => { renderer.render(scene, camera); };
  controls.addEventListener("change", draw);
  addEventListener("resize", () => { lens(renderer, camera); draw(); });
  lens(renderer, camera);
  controls.update();
  slide(spheres, draw);
  document.body.dataset.state = "drawn";
}

function slide(spheres: readonly Mesh<SphereGeometry, NacreousMaterial>[], draw: () => void): void {
  const scales = spheres.map((sphere) => sphere.material.thicknessScale);
  onSlide("scale", (value) => {
    for (const [which, sphere] of spheres.entries()) sphere.material.thicknessScale = value * (scales[which] ?? 1);
    draw();
    return `× ${value.toFixed(2)}`;
  });
  onSlide("thickness", (value) => {
    live.setThicknessNm(0, value);
    draw();
    return `${value} nm`;
  });
}

main().catch((error: unknown) => {
  element("message").textContent = error instanceof Error ? error.message : String(error);
});
