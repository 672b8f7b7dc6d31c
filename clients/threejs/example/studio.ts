/** A photographer's studio, made of a few glowing boxes: light without downloads. */

import {
  BackSide,
  BoxGeometry,
  Color,
  DoubleSide,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  PMREMGenerator,
  Scene,
  ShaderMaterial,
  SphereGeometry,
  type Texture,
  type WebGLRenderer,
} from "three";

interface Softbox {
  readonly position: readonly [number, number, number];
  readonly size: readonly [number, number];
  readonly radiance: number;
  readonly tint: number;
}

const SOFTBOXES: readonly Softbox[] = [
  { position: [-7, 8, 6], size: [9, 6], radiance: 6, tint: 0xfff4e6 },
  { position: [9, 5, 3], size: [3, 9], radiance: 4, tint: 0xe6f0ff },
  { position: [-10, 2, -3], size: [2, 8], radiance: 3, tint: 0xffffff },
  { position: [2, 11, -4], size: [12, 4], radiance: 5, tint: 0xffffff },
];

/** What the spheres mirror. */
export function studioEnvironment(renderer: WebGLRenderer): Texture {
  const studio = new Scene();
  studio.add(dome(), ...SOFTBOXES.map(softbox));
  const generator = new PMREMGenerator(renderer);
  const { texture } = generator.fromScene(studio, 0.01);
  generator.dispose();
  return texture;
}

/** Bright above, dim at the floor: films are seen by what they mirror. */
function dome(): Mesh {
  const material = new ShaderMaterial({
    side: BackSide,
    vertexShader: `
      varying vec3 direction;
      void main() {
        direction = position;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: `
      varying vec3 direction;
      void main() {
        float height = normalize(direction).y;
        vec3 above = mix(vec3(0.50, 0.52, 0.58), vec3(1.05, 1.08, 1.15), smoothstep(0.0, 0.9, height));
        gl_FragColor = vec4(mix(vec3(0.17, 0.165, 0.175), above, smoothstep(-0.25, 0.15, height)), 1.0);
      }`,
  });
  return new Mesh(new SphereGeometry(40, 48, 24), material);
}

function softbox({ position, size, radiance, tint }: Softbox): Mesh {
  const color = new Color(tint).multiplyScalar(radiance);
  const box = new Mesh(new PlaneGeometry(...size), new MeshBasicMaterial({ color, side: DoubleSide }));
  box.position.set(...position);
  box.lookAt(0, 0, 0);
  return box;
}

/** A floor that fades into the dark, with a soft shadow where each sphere stands. */
export function studioFloor(places: readonly (readonly [number, number, number])[]): Mesh {
  const material = new ShaderMaterial({
    uniforms: { shadows: { value: places.flat() } },
    vertexShader: `
      varying vec3 place;
      void main() {
        place = (modelMatrix * vec4(position, 1.0)).xyz;
        gl_Position = projectionMatrix * viewMatrix * vec4(place, 1.0);
      }`,
    fragmentShader: `
      uniform float shadows[${3 * places.length}];
      varying vec3 place;
      void main() {
        float light = 0.2 * exp(-0.018 * dot(place.xz, place.xz));
        for (int i = 0; i < ${places.length}; ++i) {
          vec3 sphere = vec3(shadows[3 * i], shadows[3 * i + 1], shadows[3 * i + 2]);
          float distance2 = dot(place.xz - sphere.xy, place.xz - sphere.xy) / (sphere.z * sphere.z);
          light *= 1.0 - 0.75 * exp(-2.2 * distance2);
        }
        gl_FragColor = vec4(light * vec3(0.92, 0.93, 1.0) + vec3(0.004, 0.004, 0.006), 1.0);
        #include <tonemapping_fragment>
        #include <colorspace_fragment>
      }`,
  });
  return new Mesh(new BoxGeometry(60, 0.01, 60), material);
}
