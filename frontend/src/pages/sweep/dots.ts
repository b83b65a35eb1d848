/** Many points on a canvas over plotly's axes: drawn at once, found by where the pointer is. */

import { outlineOf } from "../../plots/markers";
import type { Dots } from "./scatter";

/** The part of plotly's axis that says where a value lies. */
export interface DrawnAxis {
  /** [px] from the figure's edge. */
  readonly _offset: number;
  readonly _length: number;
  readonly d2p: (value: number | string) => number;
}

export interface Axes {
  readonly xaxis: DrawnAxis;
  readonly yaxis: DrawnAxis;
}

const isDrawnAxis = (axis: Partial<DrawnAxis> | undefined) =>
  typeof axis?._offset === "number" && typeof axis._length === "number" && typeof axis.d2p === "function";

/** The axes plotly has drawn in an element. They are no part of its documented interface: `null` where a version of it has others. */
export function drawnAxes(element: HTMLElement): Axes | null {
  const { _fullLayout: layout } = element as { readonly _fullLayout?: Partial<Axes> };
  return layout && isDrawnAxis(layout.xaxis) && isDrawnAxis(layout.yaxis) ? (layout as Axes) : null;
}

export interface LocatedDots {
  readonly dots: Dots;
  /** [px] from the figure's corner. */
  readonly x: Float32Array;
  readonly y: Float32Array;
}

export interface Hit {
  readonly dots: Dots;
  readonly index: number;
  readonly x: number;
  readonly y: number;
}

const HALF = 2.5;

export function locate(all: readonly Dots[], { xaxis, yaxis }: Axes): readonly LocatedDots[] {
  return all.map((dots) => ({
    dots,
    x: Float32Array.from(dots.x, (value) => xaxis._offset + xaxis.d2p(value)),
    y: Float32Array.from(dots.y, (value) => yaxis._offset + yaxis.d2p(value)),
  }));
}

const inside = ({ xaxis, yaxis }: Axes, x: number, y: number) =>
  x >= xaxis._offset && x <= xaxis._offset + xaxis._length && y >= yaxis._offset && y <= yaxis._offset + yaxis._length;

/** The nearest point within reach that is in sight; of points one upon the other, the one drawn last. */
export function nearest(located: readonly LocatedDots[], axes: Axes, x: number, y: number, radius: number): Hit | null {
  let nearest: Hit | null = null;
  let least = radius * radius;
  for (const { dots, x: xs, y: ys } of located) {
    for (let index = 0; index < xs.length; index++) {
      const [atX = NaN, atY = NaN] = [xs[index], ys[index]];
      const distance = (atX - x) ** 2 + (atY - y) ** 2;
      if (distance > least || !inside(axes, atX, atY)) continue;
      least = distance;
      nearest = { dots, index, x: atX, y: atY };
    }
  }
  return nearest;
}

/** One symbol, drawn once and then copied. */
function stamp({ colour, symbol }: Dots, hollow: boolean, ratio: number): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = Math.ceil((2 * HALF + 4) * ratio);
  const context = canvas.getContext("2d");
  if (!context) return canvas;
  context.scale(ratio, ratio);
  context.translate(HALF + 2, HALF + 2);
  context.globalAlpha = 0.75;
  const outline = new Path2D(outlineOf(symbol, HALF));
  if (hollow) {
    context.strokeStyle = colour;
    context.stroke(outline);
  } else {
    context.fillStyle = colour;
    context.fill(outline);
  }
  return canvas;
}

export function clearDots(canvas: HTMLCanvasElement): void {
  canvas.getContext("2d")?.clearRect(0, 0, canvas.width, canvas.height);
}

/** In one task, of some milliseconds. */
const AT_ONCE = 2500;

/** In pieces, until they are no longer wanted. */
export function drawDots(
  canvas: HTMLCanvasElement,
  located: readonly LocatedDots[],
  { xaxis, yaxis }: Axes,
  { width, height }: { readonly width: number; readonly height: number },
  areWanted: () => boolean,
): void {
  const ratio = window.devicePixelRatio;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext("2d");
  if (!context) return;
  context.beginPath();
  context.rect(xaxis._offset * ratio, yaxis._offset * ratio, xaxis._length * ratio, yaxis._length * ratio);
  context.clip();
  const pieces = located.flatMap(({ dots, x, y }) => {
    const [full, hollow] = [stamp(dots, false, ratio), stamp(dots, true, ratio)];
    const shift = full.width / 2;
    return Array.from({ length: Math.ceil(x.length / AT_ONCE) }, (_, piece) => () => {
      for (let index = AT_ONCE * piece; index < Math.min(AT_ONCE * (piece + 1), x.length); index++) {
        context.drawImage(
          dots.hollow[index] === true ? hollow : full,
          (x[index] ?? 0) * ratio - shift,
          (y[index] ?? 0) * ratio - shift,
        );
      }
    });
  });
  const draw = (piece: number) => {
    if (!areWanted()) return;
    pieces[piece]?.();
    if (piece + 1 < pieces.length) setTimeout(() => draw(piece + 1));
  };
  draw(0);
}
