/** Files that the page saves. */

import type { View } from "../viewer/view";

const STYLES = [
  "fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "stroke-linecap", "stroke-linejoin", "opacity", "font",
  "visibility", "paint-order",
];

export function saveFile(name: string, content: Blob): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** Save the picture and what lies over it, without handles, as a PNG. */
export async function savePicture({ canvas }: View, name: string): Promise<void> {
  const picture = document.createElement("canvas");
  [picture.width, picture.height] = [canvas.width, canvas.height];
  const onto = picture.getContext("2d") as CanvasRenderingContext2D;
  onto.fillStyle = getComputedStyle(document.documentElement).backgroundColor;
  onto.fillRect(0, 0, picture.width, picture.height);
  onto.drawImage(canvas, 0, 0);
  const overlay = canvas.parentElement?.querySelector<SVGElement>(".view3d-overlay:not(.pose-rings)");
  if (overlay) onto.drawImage(await drawStyled(overlay, canvas), 0, 0, picture.width, picture.height);
  const content = await new Promise<Blob | null>((done) => picture.toBlob(done));
  if (content) saveFile(name, content);
}

/** Draw an SVG element of the page, with its computed styles, as an image. */
async function drawStyled(element: SVGElement, { clientWidth, clientHeight }: HTMLElement): Promise<HTMLImageElement> {
  const copy = element.cloneNode(true) as SVGElement;
  const originals = [...element.querySelectorAll("*")];
  [...copy.querySelectorAll<SVGElement>("*")].forEach((part, k) => {
    const style = getComputedStyle(originals[k]);
    for (const property of STYLES) part.style.setProperty(property, style.getPropertyValue(property));
  });
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.setAttribute("width", String(clientWidth));
  copy.setAttribute("height", String(clientHeight));
  copy.setAttribute("viewBox", `0 0 ${clientWidth} ${clientHeight}`);
  const image = new Image();
  image.src = `data:image/svg+xml,${encodeURIComponent(new XMLSerializer().serializeToString(copy))}`;
  await image.decode();
  return image;
}
