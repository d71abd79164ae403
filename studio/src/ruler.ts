/** Lengths in words, and the bars over the surface that show them. */

import { el } from "./dom";
import type { Studio } from "./studio";

const plain = (value: number): string => String(Number(value.toPrecision(3)));

/** A length in world units, in millimetres and so on where the unit of the shape is known. */
export function lengthText(length: number, metresPerUnit: number | null): string {
  if (metresPerUnit === null) return plain(length);
  const metres = length * metresPerUnit;
  if (metres < 1e-3) return `${plain(metres * 1e6)} µm`;
  if (metres < 0.1) return `${plain(metres * 1e3)} mm`;
  return metres < 1 ? `${plain(metres * 100)} cm` : `${plain(metres)} m`;
}

/** The largest of 1, 2 and 5 times a power of ten that is at most so long. */
export function niceLength(longest: number): number {
  const power = 10 ** Math.floor(Math.log10(longest));
  return power * ([5, 2, 1].find((factor) => factor * power <= longest) ?? 1);
}

/** The scale bar: true at the depth around which the camera turns. Beside it, the spacing of the pattern that grows. */
export function ruler(studio: Studio): HTMLElement {
  const bar = el("div", { class: "bar" });
  const text = el("span", {});
  const beads = el("div", { class: "beads" });
  const beadText = el("span", {});
  const patternRow = el("div", { class: "ruler-row" }, beads, beadText);
  const show = (): void => {
    const perPixel = studio.scene.unitsPerPixel;
    const unit = studio.info?.metres_per_unit ?? null;
    if (!studio.info || !(perPixel > 0)) return;
    const scale = unit ?? 1;
    const length = niceLength(130 * perPixel * scale) / scale;
    bar.style.width = `${length / perPixel}px`;
    text.textContent = unit === null ? `${plain(length)} units` : lengthText(length, unit);
    const size = studio.stage?.size ?? null;
    const pixels = (size ?? 0) / perPixel;
    patternRow.hidden = size === null || pixels < 3;
    if (size === null) return;
    const count = Math.max(1, Math.min(6, Math.floor(130 / pixels)));
    beads.style.width = `${count * pixels + 1}px`;
    beads.style.backgroundSize = `${pixels}px 100%`;
    beadText.textContent = `spacing ${lengthText(size, unit)}`;
  };
  studio.scene.onView = show;
  studio.on(["begun", "stage", "shape"], show);
  return el("div", { class: "ruler", role: "img", "aria-label": "Scale bar, true at the middle of the view" }, patternRow, el("div", { class: "ruler-row" }, bar, text));
}
