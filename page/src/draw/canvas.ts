/** A canvas with the resolution of the display at any size on the page. */

export class Surface {
  readonly element: HTMLCanvasElement;
  private readonly context: CanvasRenderingContext2D;
  /** CSS pixels. */
  width = 0;
  height = 0;

  constructor(testid: string, label: string) {
    this.element = document.createElement("canvas");
    this.element.dataset.testid = testid;
    this.element.setAttribute("role", "img");
    this.element.setAttribute("aria-label", label);
    const context = this.element.getContext("2d");
    if (context === null) throw new Error("this browser cannot draw on a canvas");
    this.context = context;
  }

  /** A cleared context in CSS pixels, with the origin in the middle and y upwards. */
  begin(): CanvasRenderingContext2D {
    const { element, context } = this;
    const ratio = window.devicePixelRatio || 1;
    this.width = element.clientWidth;
    this.height = element.clientHeight;
    const [w, h] = [Math.round(this.width * ratio), Math.round(this.height * ratio)];
    if (element.width !== w || element.height !== h) [element.width, element.height] = [w, h];
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, w, h);
    context.setTransform(ratio, 0, 0, -ratio, w / 2, h / 2);
    context.lineCap = context.lineJoin = "round";
    return context;
  }
}

export function circle(c: CanvasRenderingContext2D, x: number, y: number, radius: number): void {
  c.beginPath();
  c.arc(x, y, radius, 0, 2 * Math.PI);
}

export function line(c: CanvasRenderingContext2D, ...points: [number, number][]): void {
  c.beginPath();
  points.forEach(([x, y], i) => (i ? c.lineTo(x, y) : c.moveTo(x, y)));
  c.stroke();
}

/** Draw upright text although y points upwards. */
export function label(c: CanvasRenderingContext2D, text: string, x: number, y: number): void {
  c.save();
  c.translate(x, y);
  c.scale(1, -1);
  c.fillText(text, 0, 0);
  c.restore();
}
