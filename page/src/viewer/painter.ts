/** Draws solids with WebGL, so that they intersect as they are. One canvas for all views: browsers keep few contexts alive. */

import { HullRenderer } from "./hulls";
import type { Body, Picture } from "./renderer";
import type { Part } from "./scene";
import { triangles } from "./shapes";

const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i; // names of renderers that use the processor

const VERTEX = `
attribute vec3 place, normal;
uniform mat4 seen, pose;
varying vec3 n, p;
void main() {
  vec4 world = pose * vec4(place, 1.0);
  n = mat3(pose[0].xyz, pose[1].xyz, pose[2].xyz) * normal;
  p = world.xyz;
  gl_Position = seen * world;
}`;
const FRAGMENT = `
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

/** A canvas with the program that shades triangles. */
export class Painter {
  readonly canvas = document.createElement("canvas");
  /** Whether the processor draws, which is slower than hulls. */
  readonly software: boolean;
  readonly gl: WebGLRenderingContext;
  private readonly program: WebGLProgram;
  private readonly buffers = new WeakMap<Part, { buffer: WebGLBuffer; count: number }>();

  /** Throws where there is no WebGL. */
  constructor() {
    const gl = this.canvas.getContext("webgl", { alpha: true, antialias: true, premultipliedAlpha: true });
    if (!gl) throw new Error("no WebGL");
    this.gl = gl;
    const info = gl.getExtension("WEBGL_debug_renderer_info");
    this.software = SOFTWARE.test(String(gl.getParameter(info?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER)));
    this.program = gl.createProgram() as WebGLProgram;
    for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]] as const) {
      const shader = gl.createShader(kind) as WebGLShader;
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(this.program, shader);
    }
    gl.linkProgram(this.program);
    if (!gl.getProgramParameter(this.program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(this.program) ?? "WebGL");
    gl.useProgram(this.program);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthFunc(gl.LEQUAL);
  }

  /** Begin a picture, in which nothing hides what is drawn. */
  begin({ onto: { canvas: { width, height } }, matrix, eye, up, right }: Picture): void {
    const { canvas, gl } = this;
    // Only ever larger: a new size is a new picture for the graphics card.
    if (canvas.width < width) canvas.width = width;
    if (canvas.height < height) canvas.height = height;
    gl.viewport(0, 0, width, height);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    this.set({ seen: matrix, eye, up, side: right });
  }

  /** Set uniform variables: numbers, vectors, and matrices. */
  private set(values: Record<string, number[] | Float32Array>): void {
    for (const [name, value] of Object.entries(values)) {
      const at = this.gl.getUniformLocation(this.program, name);
      if (value.length > 3) this.gl.uniformMatrix4fv(at, false, value);
      else this.gl[`uniform${value.length as 1 | 3}fv`](at, value);
    }
  }

  /** Draw bodies, each where a pose puts it; those that are over all others hide nothing, and nothing hides them. */
  draw(bodies: Body[], { onto, palette }: Picture, opacity: number, over: boolean): void {
    const { canvas, gl } = this;
    gl.clear(gl.COLOR_BUFFER_BIT);
    this.set({ opacity: [opacity] });
    const enable = (capability: number, on: boolean): void => (on ? gl.enable(capability) : gl.disable(capability));
    enable(gl.DEPTH_TEST, !over);
    // Where a see-through body is at the place of a solid one, the solid one is seen.
    enable(gl.POLYGON_OFFSET_FILL, opacity < 1);
    gl.polygonOffset(1, 8);
    // See-through bodies hide what is behind their own front.
    for (const painted of opacity < 1 ? [false, true] : [true]) {
      gl.colorMask(painted, painted, painted, painted);
      for (const { part, pose: m, color } of bodies) {
        const count = this.bind(part);
        this.set({
          pose: [0, 1, 2, 3].flatMap((k) => [m[k], m[4 + k], m[8 + k], k === 3 ? 1 : 0]),
          color: palette.dark ? color.map((x) => 0.25 + 0.75 * x) : color,
        });
        gl.drawArrays(gl.TRIANGLES, 0, count);
      }
    }
    const { width, height } = onto.canvas;
    onto.drawImage(canvas, 0, canvas.height - height, width, height, 0, 0, width, height);
  }

  /** Select the buffer of a part, and return how many vertices it has. */
  private bind(part: Part): number {
    const { gl, program } = this;
    const shape = this.buffers.has(part) ? null : triangles(part);
    const { buffer, count } = this.buffers.get(part) ?? { buffer: gl.createBuffer(), count: (shape?.length ?? 0) / 6 };
    this.buffers.set(part, { buffer, count });
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    if (shape) gl.bufferData(gl.ARRAY_BUFFER, shape, gl.STATIC_DRAW);
    ["place", "normal"].forEach((name, k) => {
      const at = gl.getAttribLocation(program, name);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, 3, gl.FLOAT, false, 24, 12 * k);
    });
    return count;
  }
}

/** Draws lines and dots as the hulls do, and solids with a painter. */
export class SolidRenderer extends HullRenderer {
  override readonly hidesFarther = true;

  constructor(picture: Picture, private readonly painter: Painter) {
    super(picture);
    painter.begin(picture);
  }

  override solids(bodies: Body[], opacity = 1, over = false): void {
    this.painter.draw(bodies, this.picture, opacity, over);
  }
}
