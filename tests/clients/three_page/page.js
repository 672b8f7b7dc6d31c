// What the tests call: each function takes and returns JSON.

import { LiveFilm, loadLookupTexture, NacreousMaterial, tableReflectance } from "@nacreous/three";
import * as THREE from "three";

const renderer = new THREE.WebGLRenderer();

async function load(paths) {
  return Promise.all(paths.map((path) => loadLookupTexture(path)));
}

function pixels(scene, camera, width, height) {
  const target = new THREE.WebGLRenderTarget(width, height, { type: THREE.FloatType });
  renderer.setRenderTarget(target);
  renderer.render(scene, camera);
  const data = new Float32Array(4 * width * height);
  renderer.readRenderTargetPixels(target, 0, 0, width, height, data);
  renderer.setRenderTarget(null);
  target.dispose();
  return Array.from({ length: width * height }, (_, pixel) => [...data.subarray(4 * pixel, 4 * pixel + 3)]);
}

/** Colours of a film at points (cos_theta, thickness_scale), by a shader of one pixel a point. */
function evaluate(reflectance, functionName, points) {
  const material = new THREE.ShaderMaterial({
    glslVersion: THREE.GLSL3,
    uniforms: { ...reflectance.uniforms, points: { value: points.map(([x, y]) => new THREE.Vector2(x, y)) } },
    vertexShader: "void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }",
    fragmentShader: `${reflectance.glsl}
      uniform vec2 points[${points.length}];
      out vec4 colour;
      void main() {
        vec2 point = points[int(gl_FragCoord.x)];
        colour = vec4(${functionName}(point.x, point.y), 1.0);
      }`,
  });
  const square = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material);
  square.frustumCulled = false;
  const scene = new THREE.Scene().add(square);
  return pixels(scene, new THREE.Camera(), points.length, 1);
}

window.describe = async (path) => {
  const { texture, ...rest } = await loadLookupTexture(path);
  return { ...rest, width: texture.image.width, height: texture.image.height };
};

window.refusal = async (path) => {
  try {
    await loadLookupTexture(path);
    return null;
  } catch (error) {
    return error.message;
  }
};

window.exchanged = async (paths) => {
  const [transmittance, reflectance] = await load(paths);
  try {
    return new NacreousMaterial({ film: reflectance, transmittance }).type;
  } catch (error) {
    return error.message;
  }
};

window.readTable = async ({ paths, points, functionName }) =>
  evaluate(tableReflectance(...(await load(paths))), functionName, points);

window.readFilm = ({ film, wavelengths, points }) =>
  evaluate(new LiveFilm(film, { wavelengths }), "nacreousReflectance", points);

function whiteSurroundings() {
  const texture = new THREE.DataTexture(new Float32Array(4).fill(1), 1, 1, THREE.RGBAFormat, THREE.FloatType);
  texture.mapping = THREE.EquirectangularReflectionMapping;
  texture.needsUpdate = true;
  return texture;
}

/** One for all pictures: three filters it once. */
const WHITE = whiteSurroundings();

/** One green value for all of a map. */
function uniformMap(green) {
  const texture = new THREE.DataTexture(new Float32Array([0, green, 0, 1]), 1, 1, THREE.RGBAFormat, THREE.FloatType);
  texture.needsUpdate = true;
  return texture;
}

const LIGHTS = {
  white: (scene) => { scene.environment = WHITE; },
  // From +x, at a right angle to the view along -z.
  lamp: (scene) => {
    const lamp = new THREE.DirectionalLight(0xffffff, 1);
    lamp.position.set(1, 0, 0);
    scene.add(lamp);
  },
  // Nothing is reflected, and what lies behind is white.
  behind: (scene) => { scene.background = new THREE.Color(1, 1, 1); },
};

async function filmMaterial({ paths, film, thicknessGreen, ...parameters }) {
  const [table, transmittance] = film ? [] : await load(paths);
  return new NacreousMaterial({
    film: film ? new LiveFilm(film) : table,
    ...(transmittance ? { transmittance } : {}),
    ...(thicknessGreen === undefined ? {} : { thicknessScaleMap: uniformMap(thicknessGreen) }),
    ...parameters,
  });
}

/** A unit sphere that fills the picture, seen from +z by parallel rays; pixels from the bottom row. */
window.renderSphere = async ({ light, size, mirror, isClone, ...parameters }) => {
  const { roughness } = parameters;
  const scene = new THREE.Scene();
  LIGHTS[light](scene);
  const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 10);
  camera.position.z = 5;
  const material = mirror
    ? new THREE.MeshPhysicalMaterial({ color: 0xffffff, metalness: 1, roughness })
    : await filmMaterial(parameters);
  scene.add(new THREE.Mesh(new THREE.SphereGeometry(1, 256, 128), isClone ? material.clone() : material));
  return pixels(scene, camera, size, size);
};

/** A sphere of one film, and again once its material shows another: its pixels, and how many programs there are. */
window.renderAnotherFilm = async ({ size, paths, otherPaths }) => {
  const scene = new THREE.Scene();
  LIGHTS.white(scene);
  const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 10);
  camera.position.z = 5;
  const material = await filmMaterial({ paths });
  scene.add(new THREE.Mesh(new THREE.SphereGeometry(1, 256, 128), material));
  pixels(scene, camera, size, size);
  const before = { programs: renderer.info.programs.length, version: material.version };
  material.setFilm(...(await load(otherPaths)));
  const after = pixels(scene, camera, size, size);
  return { pixels: after, before, after: { programs: renderer.info.programs.length, version: material.version } };
};
