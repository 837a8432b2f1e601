/** Draws triangles, lines and dots with WebGL. One for all views of a page: browsers keep only a few contexts alive. */

import type { Body, Picture, Renderer } from "./renderer";
import type { Part, Vector } from "./scene";
import { triangles } from "./shapes";

const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i; // names of renderers that use the processor

const SOLID = `
attribute vec3 place, normal;
uniform mat4 seen, pose;
varying vec3 n, p;
void main() {
  vec4 world = pose * vec4(place, 1.0);
  n = mat3(pose[0].xyz, pose[1].xyz, pose[2].xyz) * normal;
  p = world.xyz;
  gl_Position = seen * world;
}`;
const SHADED = `
precision highp float;
uniform vec3 color, eye, up, side;
uniform float opacity;
varying vec3 n, p;
void main() {
  vec3 way = normalize(eye - p);
  vec3 m = normalize(n);
  float front = dot(m, way);
  if (front < 0.0) { m = -m; front = -front; }
  float lamp = max(dot(m, normalize(way + 0.7 * up + 0.5 * side)), 0.0);
  float light = 0.46 + 0.16 * dot(m, up) + 0.46 * lamp;
  light *= 0.55 + 0.45 * smoothstep(0.0, 0.45, front);
  gl_FragColor = vec4(color * light, 1.0) * opacity;
}`;
const LINE = `
attribute vec3 place, other;
attribute float side;
uniform mat4 seen;
uniform vec2 pixels;
uniform float width;
void main() {
  vec4 a = seen * vec4(place, 1.0), b = seen * vec4(other, 1.0);
  vec2 way = normalize((b.xy / b.w - a.xy / a.w) * pixels + vec2(1e-9, 0.0));
  a.xy += side * width * vec2(-way.y, way.x) / pixels * a.w;
  a.z -= 2e-4 * a.w;
  gl_Position = a;
}`;
const FLAT = `
precision highp float;
uniform vec3 color;
uniform float opacity;
void main() { gl_FragColor = vec4(color, 1.0) * opacity; }`;
const DOT = `
attribute vec3 place, paint;
uniform mat4 seen;
uniform float width;
varying vec3 c;
void main() { c = paint; gl_Position = seen * vec4(place, 1.0); gl_PointSize = width; }`;
const ROUND = `
precision highp float;
varying vec3 c;
void main() {
  float r = length(gl_PointCoord - 0.5);
  if (r > 0.5) discard;
  gl_FragColor = vec4(c * (r > 0.38 ? 0.7 : 1.0), 1.0);
}`;

export class Painter implements Renderer {
  readonly hidesFarther = true;
  readonly canvas = document.createElement("canvas");
  /** Whether the processor draws, which is slower than hulls. */
  readonly software: boolean;
  private readonly gl: WebGLRenderingContext;
  private readonly programs: Record<"solid" | "line" | "dot", WebGLProgram>;
  private readonly buffers = new WeakMap<Part, { buffer: WebGLBuffer; count: number }>();
  private readonly scratch: WebGLBuffer;
  private program: WebGLProgram;
  private picture: Picture | null = null;

  /** Throws where there is no WebGL. */
  constructor() {
    const gl = this.canvas.getContext("webgl", { alpha: true, antialias: true, premultipliedAlpha: true });
    if (!gl) throw new Error("no WebGL");
    this.gl = gl;
    const info = gl.getExtension("WEBGL_debug_renderer_info");
    this.software = SOFTWARE.test(String(gl.getParameter(info?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER)));
    this.programs = { solid: this.built(SOLID, SHADED), line: this.built(LINE, FLAT), dot: this.built(DOT, ROUND) };
    this.program = this.programs.solid;
    this.scratch = gl.createBuffer() as WebGLBuffer;
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthFunc(gl.LEQUAL);
  }

  get lost(): boolean {
    return this.gl.isContextLost();
  }

  private built(vertex: string, fragment: string): WebGLProgram {
    const gl = this.gl;
    const program = gl.createProgram() as WebGLProgram;
    for (const [kind, text] of [
      [gl.VERTEX_SHADER, vertex],
      [gl.FRAGMENT_SHADER, fragment],
    ] as const) {
      const shader = gl.createShader(kind) as WebGLShader;
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program) ?? "WebGL");
    return program;
  }

  begin(picture: Picture): this {
    const { canvas, gl } = this;
    const { width, height } = picture.onto.canvas;
    // Only ever larger: a new size is a new picture for the graphics card.
    if (canvas.width < width) canvas.width = width;
    if (canvas.height < height) canvas.height = height;
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.depthMask(true);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.picture = picture;
    return this;
  }

  /** Copy the picture onto the canvas of its view. */
  finish(): void {
    const { onto } = this.picture as Picture;
    const { width, height } = onto.canvas;
    onto.drawImage(this.canvas, 0, this.canvas.height - height, width, height, 0, 0, width, height);
  }

  /** Select a program, with values of its uniform variables. */
  private use(name: "solid" | "line" | "dot", values: Record<string, number[]>): void {
    this.program = this.programs[name];
    this.gl.useProgram(this.program);
    this.set({ seen: (this.picture as Picture).matrix, ...values });
  }

  /** Set uniform variables: numbers, vectors, and matrices. */
  private set(values: Record<string, number[] | Float32Array>): void {
    for (const [name, value] of Object.entries(values)) {
      const at = this.gl.getUniformLocation(this.program, name);
      if (value.length > 3) this.gl.uniformMatrix4fv(at, false, value);
      else this.gl[`uniform${value.length as 1 | 2 | 3}fv`](at, value);
    }
  }

  /** Describe the numbers of each vertex in the buffer, and return how many there are. */
  private attributes(layout: [string, number][]): number {
    const gl = this.gl;
    const count = layout.reduce((n, [, size]) => n + size, 0);
    let offset = 0;
    for (let k = 0; k < 3; k++) gl.disableVertexAttribArray(k);
    for (const [name, size] of layout) {
      const at = gl.getAttribLocation(this.program, name);
      if (at >= 0) {
        gl.enableVertexAttribArray(at);
        gl.vertexAttribPointer(at, size, gl.FLOAT, false, 4 * count, offset);
      }
      offset += 4 * size;
    }
    return count;
  }

  /** Bodies, each where a pose puts it. See-through ones hide what is behind their own front. */
  solids(bodies: Body[], opacity = 1): void {
    const gl = this.gl;
    const { eye, up, right, palette } = this.picture as Picture;
    this.use("solid", { eye, up, side: right, opacity: [opacity] });
    // Where a see-through body is at the place of a solid one, the solid one is seen.
    if (opacity < 1) gl.enable(gl.POLYGON_OFFSET_FILL);
    else gl.disable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 8);
    for (const painted of opacity < 1 ? [false, true] : [true]) {
      gl.colorMask(painted, painted, painted, painted);
      for (const { part, pose: m, color } of bodies) {
        const count = this.bind(part);
        this.attributes([["place", 3], ["normal", 3]]);
        this.set({
          pose: [0, 1, 2, 3].flatMap((k) => [m[k], m[4 + k], m[8 + k], k === 3 ? 1 : 0]),
          color: palette.dark ? color.map((x) => 0.25 + 0.75 * x) : color,
        });
        gl.drawArrays(gl.TRIANGLES, 0, count);
      }
    }
  }

  /** Select the buffer of a part, and return how many vertices it has. */
  private bind(part: Part): number {
    const gl = this.gl;
    const known = this.buffers.get(part);
    const buffer = known?.buffer ?? (gl.createBuffer() as WebGLBuffer);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    if (known) return known.count;
    const shape = triangles(part);
    gl.bufferData(gl.ARRAY_BUFFER, shape, gl.STATIC_DRAW);
    this.buffers.set(part, { buffer, count: shape.length / 6 });
    return shape.length / 6;
  }

  lines(points: Vector[], color: Vector, width: number, opacity = 1): void {
    const data: number[] = [];
    for (let k = 0; k + 1 < points.length; k += 2) {
      const [a, b] = [points[k], points[k + 1]];
      // Seen from b the sides are swapped.
      const corners = [[...a, ...b, 1], [...a, ...b, -1], [...b, ...a, 1], [...b, ...a, -1]];
      for (const j of [0, 1, 2, 0, 2, 3]) data.push(...corners[j]);
    }
    const { onto: { canvas }, ratio } = this.picture as Picture;
    const pixels = [canvas.width / 2, canvas.height / 2];
    this.use("line", { pixels, width: [(width * ratio) / 2], color, opacity: [opacity] });
    this.drawOnce(data, [["place", 3], ["other", 3], ["side", 1]], this.gl.TRIANGLES);
  }

  dots(points: Vector[], colors: Vector[], width: number): void {
    this.use("dot", { width: [width * (this.picture as Picture).ratio] });
    this.drawOnce(points.flatMap((p, k) => [...p, ...colors[k]]), [["place", 3], ["paint", 3]], this.gl.POINTS);
  }

  private drawOnce(data: number[], layout: [string, number][], mode: number): void {
    const gl = this.gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.scratch);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(data), gl.DYNAMIC_DRAW);
    gl.drawArrays(mode, 0, data.length / this.attributes(layout));
  }

  /** Whatever is drawn next hides nothing, and is hidden by nothing, or as usual again. */
  over(on: boolean): void {
    if (on) this.gl.disable(this.gl.DEPTH_TEST);
    else this.gl.enable(this.gl.DEPTH_TEST);
  }
}
