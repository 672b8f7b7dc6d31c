// Runs a fragment shader on a table of float texels into float pixels: plain WebGL 2, as a graphics interface is.

const VERTICES = `#version 300 es
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }`;

function compile(gl, type, source) {
  const shader = gl.createShader(type);
  gl.shaderSource(shader, source);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
  return shader;
}

function link(gl, fragment) {
  const program = gl.createProgram();
  gl.attachShader(program, compile(gl, gl.VERTEX_SHADER, VERTICES));
  gl.attachShader(program, compile(gl, gl.FRAGMENT_SHADER, fragment));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  gl.useProgram(program);
  return program;
}

/** The first row given is at v = 0, as in Direct3D. The format is that of the texels in memory. */
function upload(gl, unit, rows, format, filter) {
  gl.activeTexture(gl.TEXTURE0 + unit);
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  const data = new Float32Array(rows.flat().flatMap((texel) => [...texel, 1]));
  gl.texImage2D(gl.TEXTURE_2D, 0, format, rows[0].length, rows.length, 0, gl.RGBA, gl.FLOAT, data);
  for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, side, filter);
  for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) {
    gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
  }
}

/** The combined samplers' names hold those of the HLSL textures. */
function bindSamplers(gl, program) {
  for (let uniform = 0; uniform < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++uniform) {
    const { name, type } = gl.getActiveUniform(program, uniform);
    if (type === gl.SAMPLER_2D) gl.uniform1i(gl.getUniformLocation(program, name), name.includes("Places") ? 1 : 0);
  }
}

function bindConstants(gl, program, constants) {
  const buffer = gl.createBuffer();
  gl.bindBufferBase(gl.UNIFORM_BUFFER, 0, buffer);
  gl.bufferData(gl.UNIFORM_BUFFER, new Float32Array(constants), gl.STATIC_DRAW);
  gl.uniformBlockBinding(program, 0, 0);
}

function target(gl, width, height) {
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, width, height);
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  gl.framebufferTexture2D(
    gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, gl.getParameter(gl.TEXTURE_BINDING_2D), 0,
  );
  gl.viewport(0, 0, width, height);
}

/**
 * Colours and alpha of all pixels, one after another. The first row is the one whose position.y is 0.5: the top row,
 * as in Direct3D. `format` names that of the table's texels, RGBA32F or RGBA16F.
 */
window.run = ({ fragment, rows, format, places, constants, width, height }) => {
  const gl = document.createElement("canvas").getContext("webgl2");
  gl.getExtension("EXT_color_buffer_float");
  gl.getExtension("OES_texture_float_linear");
  const program = link(gl, fragment);
  gl.activeTexture(gl.TEXTURE2);
  target(gl, width, height);
  upload(gl, 0, rows, gl[format], gl.LINEAR);
  if (places) upload(gl, 1, [places.map((place) => [...place, 0])], gl.RGBA32F, gl.NEAREST);
  bindSamplers(gl, program);
  bindConstants(gl, program, constants);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
  const data = new Float32Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, data);
  gl.getExtension("WEBGL_lose_context").loseContext(); // a page may hold but a few
  return [...data];
};
