/** Play, pause, step, again, speed; time, steps, stage and status of the growth. */

import { button, el, icon } from "../dom";
import { plot, shortNumber } from "../plot";
import { speeds, type Studio } from "../studio";
import { speciesColors } from "./readout";

function words(studio: Studio): string {
  const progress = studio.progress;
  if (studio.busy) return studio.busy;
  if (!progress || !studio.begun) return "";
  if (progress.status === "failed") return progress.message || "failed";
  if (progress.uniform) return `uniform${progress.why_uniform ? `: ${progress.why_uniform}` : ""}`;
  if (!studio.playing) return progress.running ? "paused" : progress.status;
  return progress.running ? "growing" : `growing on (${progress.status})`;
}

function readings(studio: Studio): { node: HTMLElement; follow: () => void } {
  const values: Record<string, HTMLElement> = {};
  const node = el("dl", { class: "readings" });
  for (const name of ["Stage", "Time", "Steps", "Steps/s"]) {
    values[name] = el("dd", {}, "–");
    node.append(el("div", {}, el("dt", {}, name), values[name]!));
  }
  const follow = (): void => {
    const progress = studio.progress;
    const stages = studio.begun?.stages ?? [];
    if (!progress) return;
    const stage = stages[progress.stage];
    values["Stage"]!.textContent = stages.length > 1 ? `${progress.stage + 1}/${stages.length} ${stage?.name ?? ""}` : "1/1";
    values["Time"]!.textContent = shortNumber(progress.time, 4);
    values["Steps"]!.textContent = progress.steps.toLocaleString("en-US");
    values["Steps/s"]!.textContent = studio.playing ? shortNumber(Math.round(studio.stepsPerSecond)) : "–";
  };
  return { node, follow };
}

function speedControl(studio: Studio): HTMLElement {
  const input = el("input", { type: "range", min: 0, max: speeds.length - 1, step: 1, id: "speed", "aria-label": "Speed" });
  const follow = (): void => {
    input.value = String(studio.speed);
    input.style.setProperty("--fill", `${(100 * studio.speed) / (speeds.length - 1)}%`);
    const ms = speeds[studio.speed]!;
    input.setAttribute("aria-valuetext", ms === 0 ? "single steps" : `${ms} milliseconds of growth a picture`);
    input.title = ms === 0 ? "Single steps" : `${ms} ms of growth a picture`;
  };
  input.addEventListener("input", () => {
    studio.setView({ speed: Number(input.value) });
    follow();
  });
  studio.on("ready", follow);
  return el("div", { class: "speed" }, el("label", { for: "speed" }, "Speed"), input);
}

export function transport(studio: Studio): HTMLElement {
  const play = button("", { icon: "play", label: "Play", keys: "Space", class: "play" });
  const step = button("", { icon: "step", label: "One step", keys: "." });
  const again = button("", { icon: "reset", label: "Begin anew", keys: "R" });
  play.addEventListener("click", () => studio.togglePlay());
  step.addEventListener("click", () => void studio.stepOnce());
  again.addEventListener("click", () => studio.restart());
  const spark = el("canvas", { class: "spark", role: "img", "aria-label": "Change over the last steps" });
  const status = el("span", { class: "status-word" });
  const bar = el("div", { class: "fraction", role: "progressbar", "aria-label": "Growth", "aria-valuemin": 0, "aria-valuemax": 100 });
  const fill = el("i", {});
  bar.append(fill);
  const numbers = readings(studio);
  let drawn = 0;

  const follow = (): void => {
    status.textContent = words(studio);
    status.title = status.textContent;
    if (performance.now() - drawn < 90 && studio.playing) return;
    drawn = performance.now();
    numbers.follow();
    const fraction = Math.round(100 * Math.min(1, Math.max(0, studio.progress?.fraction ?? 0)));
    fill.style.width = `${fraction}%`;
    bar.setAttribute("aria-valuenow", String(fraction));
    plot(spark, { lines: [{ x: studio.series.time, y: studio.series.change, color: speciesColors[1]! }], logY: true });
  };
  const playing = (): void => {
    play.querySelector("svg")?.replaceWith(icon(studio.playing ? "pause" : "play"));
    play.setAttribute("aria-label", studio.playing ? "Pause" : "Play");
    play.title = `${studio.playing ? "Pause" : "Play"} (Space)`;
    drawn = 0;
    follow();
  };
  studio.on(["frame", "busy", "begun"], follow);
  studio.on("playing", playing);
  return el(
    "section",
    { class: "transport", "aria-label": "Growth" },
    bar,
    el("div", { class: "transport-row" }, el("div", { class: "buttons" }, play, step, again), speedControl(studio), status, spark, numbers.node),
  );
}
