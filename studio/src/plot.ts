/** Small line plots on a canvas. */

export interface Line {
  x: ArrayLike<number | null>;
  y: ArrayLike<number | null>;
  color: string;
  fill?: string;
}

export interface PlotOptions {
  lines: Line[];
  logY?: boolean;
  zeroLine?: boolean;
  /** What lies far below zero is cut off, so that what grows is seen. */
  clipBelow?: boolean;
  xLabel?: string;
  yLabel?: string;
  markX?: number | null;
}

interface Range {
  low: number;
  high: number;
}

const margin = { left: 40, right: 8, top: 8, bottom: 18 };

export function shortNumber(value: number | null | undefined, digits = 3): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e5)) return value.toExponential(1).replace("e+", "e");
  return String(Number(value.toPrecision(digits)));
}

function rangeOf(values: Iterable<number>): Range | null {
  let low = Infinity;
  let high = -Infinity;
  for (const v of values) {
    if (v < low) low = v;
    if (v > high) high = v;
  }
  if (low > high) return null;
  if (low === high) return { low: low - Math.max(1e-6, Math.abs(low) * 0.1), high: high + Math.max(1e-6, Math.abs(high) * 0.1) };
  return { low, high };
}

function* points(line: Line, logY: boolean): Generator<[number, number]> {
  for (let i = 0; i < line.x.length; ++i) {
    const x = line.x[i];
    const y = line.y[i];
    if (typeof x !== "number" || typeof y !== "number" || (logY && y <= 0)) continue;
    yield [x, logY ? Math.log10(y) : y];
  }
}

function* coordinate(lines: Line[], logY: boolean, which: 0 | 1): Generator<number> {
  for (const line of lines) for (const point of points(line, logY)) yield point[which];
}

function fit(canvas: HTMLCanvasElement): CanvasRenderingContext2D | null {
  const scale = Math.min(2, devicePixelRatio || 1);
  const width = Math.round(canvas.clientWidth * scale);
  const height = Math.round(canvas.clientHeight * scale);
  if (!width || !height) return null;
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  const context = canvas.getContext("2d");
  context?.setTransform(scale, 0, 0, scale, 0, 0);
  context?.clearRect(0, 0, canvas.clientWidth, canvas.clientHeight);
  return context;
}

/** Draws the lines, with their smallest and largest values at the axes. */
export function plot(canvas: HTMLCanvasElement, options: PlotOptions): void {
  const context = fit(canvas);
  if (!context) return;
  const logY = options.logY ?? false;
  const xs = rangeOf(coordinate(options.lines, logY, 0));
  const ys = rangeOf(coordinate(options.lines, logY, 1));
  if (ys && options.clipBelow) ys.low = Math.max(ys.low, -Math.max(3 * ys.high, -0.15 * ys.low));
  const { clientWidth: width, clientHeight: height } = canvas;
  const bare = height < 60;
  const left = bare ? 1 : margin.left;
  const bottom = bare ? 2 : margin.bottom;
  if (!xs || !ys) return;
  const px = (x: number): number => left + ((x - xs.low) / (xs.high - xs.low)) * (width - left - (bare ? 1 : margin.right));
  const py = (y: number): number => height - bottom - ((y - ys.low) / (ys.high - ys.low)) * (height - bottom - (bare ? 3 : margin.top));
  const text = getComputedStyle(canvas).color;
  if (options.zeroLine && ys.low < 0 && ys.high > 0) line(context, [[left, py(0)], [width, py(0)]], text, 0.5);
  if (typeof options.markX === "number") line(context, [[px(options.markX), 0], [px(options.markX), height - bottom]], text, 0.5, [3, 3]);
  context.save();
  for (const one of options.lines) {
    if (options.clipBelow) clip(context, left, width, height - bottom);
    line(context, [...points(one, logY)].map(([x, y]): [number, number] => [px(x), py(y)]), one.color, 1.5);
  }
  context.restore();
  if (!bare) axes(context, canvas, options, xs, ys, text);
}

function clip(context: CanvasRenderingContext2D, left: number, width: number, bottom: number): void {
  context.beginPath();
  context.rect(left, 0, width - left, bottom);
  context.clip();
}

function line(context: CanvasRenderingContext2D, at: [number, number][], color: string, width: number, dash: number[] = []): void {
  context.strokeStyle = color;
  context.lineWidth = width;
  context.lineJoin = "round";
  context.setLineDash(dash);
  context.beginPath();
  at.forEach(([x, y], i) => (i ? context.lineTo(x, y) : context.moveTo(x, y)));
  context.stroke();
}

function axes(context: CanvasRenderingContext2D, canvas: HTMLCanvasElement, options: PlotOptions, xs: Range, ys: Range, text: string): void {
  if (ys && options.clipBelow) ys.low = Math.max(ys.low, -Math.max(3 * ys.high, -0.15 * ys.low));
  const { clientWidth: width, clientHeight: height } = canvas;
  const bottom = height - margin.bottom;
  context.fillStyle = text;
  context.font = "10px system-ui, sans-serif";
  const tick = (y: number): string => shortNumber(options.logY ? 10 ** y : Math.abs(y) < 1e-9 * (ys.high - ys.low) ? 0 : y, 3);
  context.textAlign = "right";
  context.fillText(tick(ys.high), margin.left - 5, margin.top + 5);
  context.fillText(tick(ys.low), margin.left - 5, bottom);
  context.textAlign = "left";
  context.fillText(shortNumber(xs.low), margin.left, height - 5);
  context.textAlign = "right";
  context.fillText(shortNumber(xs.high), width - margin.right, height - 5);
  context.textAlign = "center";
  context.fillText(options.xLabel ?? "", (margin.left + width) / 2, height - 5);
  line(context, [[margin.left, margin.top], [margin.left, bottom], [width - margin.right, bottom]], text, 0.5);
}
