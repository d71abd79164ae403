/**
 * Edits of a recipe's text (TOML) that leave all else as it is, comments and layout included. It is no parser of TOML: it
 * finds tables and keys, and where their values begin and end. What it cannot find it does not edit.
 */

import type { Vec3 } from "./protocol";

export interface Entry {
  key: string;
  start: number;
  valueStart: number;
  valueEnd: number;
}

export interface Section {
  /** Dotted name of the table; "" for what stands above the first one. */
  name: string;
  array: boolean;
  start: number;
  /** Where its entries begin, behind the line of its header. */
  body: number;
  end: number;
  entries: Entry[];
}

function lineEnd(text: string, at: number): number {
  const end = text.indexOf("\n", at);
  return end < 0 ? text.length : end;
}

/** The end of the string that begins at `at`. */
function stringEnd(text: string, at: number): number {
  const quote = text[at]!;
  const long = text.startsWith(quote.repeat(3), at);
  const close = long ? quote.repeat(3) : quote;
  for (let i = at + close.length; i < text.length; ++i) {
    if (text[i] === "\\" && quote === '"') ++i;
    else if (text.startsWith(close, i)) return i + close.length;
    else if (!long && text[i] === "\n") return i;
  }
  return text.length;
}

/** The end of the value that begins at `at`, without blanks and comments behind it. `inline`: within braces. */
function valueEnd(text: string, at: number, inline = false): number {
  let depth = 0;
  let end = at;
  for (let i = at; i < text.length; ) {
    const c = text[i]!;
    if (c === '"' || c === "'") {
      i = end = stringEnd(text, i);
      continue;
    }
    if (c === "#") {
      if (depth === 0) return end;
      i = lineEnd(text, i);
      continue;
    }
    if (depth === 0 && (c === "\n" || (inline && (c === "," || c === "}")))) return end;
    if (c === "[" || c === "{") ++depth;
    if (c === "]" || c === "}") --depth;
    ++i;
    if (c.trim()) end = i;
  }
  return end;
}

const keyPattern = /((?:[A-Za-z0-9_-]+|"[^"\n]*"|'[^'\n]*')(?:[ \t]*\.[ \t]*(?:[A-Za-z0-9_-]+|"[^"\n]*"|'[^'\n]*'))*)[ \t]*=[ \t]*/y;
const headerPattern = /[ \t]*(\[\[?)([^\]\n]*)\]/y;

const plainKey = (key: string): string => key.replace(/["'\s]/g, "");

function keyAt(text: string, at: number): { key: string; value: number } | null {
  keyPattern.lastIndex = at;
  const match = keyPattern.exec(text);
  return match ? { key: plainKey(match[1]!), value: keyPattern.lastIndex } : null;
}

/** The tables of a text in their order, the part above the first one included. */
export function sections(text: string): Section[] {
  let current: Section = { name: "", array: false, start: 0, body: 0, end: text.length, entries: [] };
  const found = [current];
  for (let at = 0; at < text.length; ) {
    while (text[at] === " " || text[at] === "\t") ++at;
    headerPattern.lastIndex = at;
    const header = text[at] === "[" ? headerPattern.exec(text) : null;
    if (header) {
      current.end = at;
      const body = Math.min(text.length, lineEnd(text, at) + 1);
      current = { name: plainKey(header[2]!), array: header[1] === "[[", start: at, body, end: text.length, entries: [] };
      found.push(current);
    }
    const entry = header ? null : keyAt(text, at);
    if (entry) {
      const end = valueEnd(text, entry.value);
      current.entries.push({ key: entry.key, start: at, valueStart: entry.value, valueEnd: end });
      at = end;
    }
    at = lineEnd(text, at) + 1;
  }
  return found;
}

/** The entries of an inline table whose brace stands at `at`. */
function inlineEntries(text: string, at: number): Entry[] {
  const found: Entry[] = [];
  for (let i = at + 1; i < text.length && text[i] !== "}"; ) {
    const entry = keyAt(text, i);
    if (!entry) {
      if (text[i] === "#") i = lineEnd(text, i);
      ++i;
      continue;
    }
    const end = valueEnd(text, entry.value, true);
    found.push({ key: entry.key, start: i, valueStart: entry.value, valueEnd: end });
    i = end;
  }
  return found;
}

const replace = (text: string, start: number, end: number, by: string): string => text.slice(0, start) + by + text.slice(end);

/** Where a new line of a section goes: behind its last entry, or right behind its header. */
function insertionPoint(text: string, section: Section): number {
  const last = section.entries[section.entries.length - 1];
  return last ? Math.min(text.length, lineEnd(text, last.valueEnd) + 1) : section.body;
}

function insertLine(text: string, at: number, line: string): string {
  const before = at > 0 && text[at - 1] !== "\n" ? "\n" : "";
  return replace(text, at, at, `${before}${line}\n`);
}

/** Sets a key of a section, which is one of `sections(text)`, to a value as it stands in TOML. */
export function setKey(text: string, section: Section, key: string, value: string): string {
  const entry = section.entries.find((candidate) => candidate.key === key);
  if (entry) return replace(text, entry.valueStart, entry.valueEnd, value);
  return insertLine(text, insertionPoint(text, section), `${key} = ${value}`);
}

/** Takes a key out of a section, with its line. */
export function removeKey(text: string, section: Section, key: string): string {
  const entry = section.entries.find((candidate) => candidate.key === key);
  if (!entry) return text;
  const start = text.lastIndexOf("\n", entry.start - 1) + 1;
  return replace(text, start, Math.min(text.length, lineEnd(text, entry.valueEnd) + 1), "");
}

/** The value of a key as it stands in the text, or null. */
export function rawValue(text: string, section: Section | undefined, key: string): string | null {
  const entry = section?.entries.find((candidate) => candidate.key === key);
  return entry ? text.slice(entry.valueStart, entry.valueEnd) : null;
}

/** A string of a text without its quotes; null if the value is none. */
export function stringValue(raw: string | null): string | null {
  if (!raw || !/^["']/.test(raw)) return null;
  if (raw.startsWith('"""') || raw.startsWith("'''")) return raw.slice(3, -3);
  if (raw[0] === "'") return raw.slice(1, -1);
  try {
    const value: unknown = JSON.parse(raw);
    return typeof value === "string" ? value : null;
  } catch {
    return raw.slice(1, -1);
  }
}

/** The number that a value is, or null. */
export function numberValue(raw: string | null): number | null {
  if (raw === null || !/^[+-]?(\d|\.\d)/.test(raw)) return null;
  const value = Number(raw.replace(/_/g, ""));
  return Number.isFinite(value) ? value : null;
}

export const quoted = (value: string): string => JSON.stringify(value);

/** A number in few digits, as TOML takes it. */
export function numberText(value: number): string {
  if (!Number.isFinite(value)) return "0";
  return String(Number(value.toPrecision(5)));
}

/** The section of the stage of this number, from 0. */
export function stageSection(text: string, stage: number): Section | undefined {
  return sections(text).filter((section) => section.name === "stage")[stage];
}

export function stageCount(text: string): number {
  return sections(text).filter((section) => section.name === "stage").length;
}

/** The table `[stage.NAME]` of a stage, which stands behind the stage's own and before the next stage. */
function stageTable(text: string, stage: number, name: string): Section | undefined {
  let count = -1;
  for (const section of sections(text)) {
    if (section.name === "stage") ++count;
    else if (count === stage && section.name === `stage.${name}`) return section;
  }
  return undefined;
}

/** Sets a key of a stage; a text without that stage comes back as it was. */
export function setStageKey(text: string, stage: number, key: string, value: string): string {
  const section = stageSection(text, stage);
  return section ? setKey(text, section, key, value) : text;
}

export function stageValue(text: string, stage: number, key: string): string | null {
  return rawValue(text, stageSection(text, stage), key);
}

/** Where a stage has a group of keys, as `parameters`: in a table of their own, in braces, or with dotted names. */
interface GroupPlace {
  table: Section | undefined;
  own: Section | undefined;
  inline: Entry | undefined;
}

function groupPlace(text: string, stage: number, group: string): GroupPlace {
  const own = stageSection(text, stage);
  const inline = own?.entries.find((entry) => entry.key === group);
  return { table: stageTable(text, stage, group), own, inline };
}

function groupValue(text: string, stage: number, group: string, name: string): string | null {
  const { table, own, inline } = groupPlace(text, stage, group);
  if (table) return rawValue(text, table, name);
  const within = inline && inlineEntries(text, inline.valueStart).find((entry) => entry.key === name);
  return within ? text.slice(within.valueStart, within.valueEnd) : rawValue(text, own, `${group}.${name}`);
}

function setInline(text: string, inline: Entry, name: string, value: string): string {
  const all = inlineEntries(text, inline.valueStart);
  const entry = all.find((candidate) => candidate.key === name);
  if (entry) return replace(text, entry.valueStart, entry.valueEnd, value);
  const last = all[all.length - 1];
  if (last) return replace(text, last.valueEnd, last.valueEnd, `, ${name} = ${value}`);
  return replace(text, inline.valueStart, inline.valueEnd, `{ ${name} = ${value} }`);
}

/** Sets a key of a group where the text has it: in its table, in braces, or in new braces. */
function setInGroup(text: string, stage: number, group: string, name: string, value: string): string {
  const { table, own, inline } = groupPlace(text, stage, group);
  if (table) return setKey(text, table, name, value);
  if (!own) return text;
  if (inline) return setInline(text, inline, name, value);
  if (own.entries.some((entry) => entry.key.startsWith(`${group}.`))) return setKey(text, own, `${group}.${name}`, value);
  return setKey(text, own, group, `{ ${name} = ${value} }`);
}

function removeInline(text: string, inline: Entry, name: string): string {
  const all = inlineEntries(text, inline.valueStart);
  const index = all.findIndex((candidate) => candidate.key === name);
  if (index < 0) return text;
  const start = index > 0 ? all[index - 1]!.valueEnd : all[index]!.start;
  const end = index > 0 || all.length === 1 ? all[index]!.valueEnd : all[index + 1]!.start;
  return replace(text, start, end, "");
}

function removeFromGroup(text: string, stage: number, group: string, name: string): string {
  const { table, own, inline } = groupPlace(text, stage, group);
  if (table) return removeKey(text, table, name);
  if (!own) return text;
  if (!inline) return removeKey(text, own, `${group}.${name}`);
  if (inlineEntries(text, inline.valueStart).length > 1) return removeInline(text, inline, name);
  return groupValue(text, stage, group, name) === null ? text : removeKey(text, own, group);
}

/** A parameter of a stage as it stands in the text, or null where the model's own value holds. */
export function parameterValue(text: string, stage: number, name: string): string | null {
  return groupValue(text, stage, "parameters", name);
}

export function setParameter(text: string, stage: number, name: string, value: string): string {
  return setInGroup(text, stage, "parameters", name, value);
}

/** Takes a parameter out of a stage, so that the model's own value holds again. */
export function removeParameter(text: string, stage: number, name: string): string {
  return removeFromGroup(text, stage, "parameters", name);
}

/** Sets a key above the first table. */
export function setTopKey(text: string, key: string, value: string): string {
  return setKey(text, sections(text)[0]!, key, value);
}

export function topValue(text: string, key: string): string | null {
  return rawValue(text, sections(text)[0], key);
}

function lookSection(text: string): Section | undefined {
  return sections(text).find((section) => section.name === "look");
}

export function lookValue(text: string, key: string): string | null {
  return rawValue(text, lookSection(text), key);
}

/** Sets a key of `[look]`; the table is made where there is none: before its layers, or at the end. */
export function setLookKey(text: string, key: string, value: string): string {
  const look = lookSection(text);
  if (look) return setKey(text, look, key, value);
  const layer = sections(text).find((section) => section.name.startsWith("look."));
  const table = `[look]\n${key} = ${value}\n`;
  if (layer) return replace(text, layer.start, layer.start, `${table}\n`);
  return `${text.replace(/\s*$/, "")}\n\n${table}`;
}

export function removeLookKey(text: string, key: string): string {
  const look = lookSection(text);
  return look ? removeKey(text, look, key) : text;
}

/** What a change of the text needs: nothing, other colours, new parameters or equations while it grows, or a new start. */
export type Change = "none" | "look" | "keep" | "restart";

interface Parts {
  rest: string;
  look: string;
  parameters: string;
}

function split(text: string): Parts {
  const parts: Parts = { rest: "", look: "", parameters: "" };
  for (const section of sections(text)) {
    const header = `[${section.name}]`;
    const isLook = section.name === "look" || section.name.startsWith("look.");
    const whileGrowing = section.name === "stage.parameters" || section.name === "models";
    const kind = isLook ? "look" : whileGrowing ? "parameters" : "rest";
    if (section.name && kind !== "parameters") parts[kind] += header;
    for (const entry of section.entries) {
      const line = `${entry.key}=${text.slice(entry.valueStart, entry.valueEnd)}\n`;
      const inline = section.name === "stage" && (entry.key === "parameters" || entry.key.startsWith("parameters."));
      if (section.name || (entry.key !== "name" && entry.key !== "summary")) parts[inline ? "parameters" : kind] += line;
    }
  }
  return parts;
}

export function changeBetween(before: string, after: string): Change {
  const a = split(before);
  const b = split(after);
  if (a.rest !== b.rest) return "restart";
  if (a.parameters !== b.parameters) return "keep";
  return a.look === b.look ? "none" : "look";
}

export interface Stroke {
  radius: number;
  value: number;
  hardness: number;
  points: Vec3[];
}

function brushSections(text: string, name: string): { head: Section; strokes: Section[] } | null {
  let head: Section | null = null;
  const strokes: Section[] = [];
  for (const section of sections(text)) {
    if (section.name === "brush") {
      if (head) break;
      if (stringValue(rawValue(text, section, "name")) === name) head = section;
    } else if (head && section.name === "brush.stroke") {
      strokes.push(section);
    }
  }
  return head ? { head, strokes } : null;
}

function strokeText(stroke: Stroke): string {
  const numbers = [`radius = "${numberText(stroke.radius)}u"`, `value = ${numberText(stroke.value)}`];
  return `[[brush.stroke]]\n${numbers.join("\n")}\nhardness = ${numberText(stroke.hardness)}\npoints = ${pointsText(stroke.points)}\n`;
}

/** Adds a stroke to the brush of this name, behind its others; the brush is made at the end where there is none. */
export function addStroke(text: string, name: string, stroke: Stroke): string {
  const brush = brushSections(text, name);
  if (!brush) return `${text.replace(/\s*$/, "")}\n\n[[brush]]\nname = ${quoted(name)}\n${strokeText(stroke)}`;
  const last = brush.strokes[brush.strokes.length - 1] ?? brush.head;
  return insertLine(text, insertionPoint(text, last), strokeText(stroke).trimEnd());
}

/** Arrays of numbers as TOML and JSON have them alike, but for comments and commas at the end. */
function arrayValue(raw: string | null): unknown[] {
  try {
    const value: unknown = JSON.parse((raw ?? "[]").replace(/#[^\n]*/g, "").replace(/,(\s*\])/g, "$1"));
    return Array.isArray(value) ? value : [];
  } catch {
    return [];
  }
}

const isPoint = (p: unknown): p is Vec3 => Array.isArray(p) && p.length === 3 && p.every(Number.isFinite);
const pointsOf = (value: unknown): Vec3[] => (Array.isArray(value) ? value.filter(isPoint) : []);
const pointsText = (points: Vec3[]): string => `[${points.map((point) => `[${point.map(numberText).join(", ")}]`).join(", ")}]`;

/** The strokes that the anisotropic diffusion of a stage follows. */
export function directionStrokes(text: string, stage: number): Vec3[][] {
  return arrayValue(groupValue(text, stage, "directions", "strokes")).map(pointsOf).filter((stroke) => stroke.length > 1);
}

/** Adds strokes to those of a stage; what else its directions follow stays. */
export function addDirections(text: string, stage: number, strokes: Vec3[][]): string {
  const all = [...directionStrokes(text, stage), ...strokes].map(pointsText);
  return setInGroup(text, stage, "directions", "strokes", `[${all.join(", ")}]`);
}

export function removeDirections(text: string, stage: number): string {
  return removeFromGroup(text, stage, "directions", "strokes");
}

/** A length in world units: "0.03u", or a number, which is a fraction of the diagonal. */
function worldLength(raw: string | null, diagonal: number): number {
  const units = /^([0-9.eE+-]+)u$/.exec(stringValue(raw) ?? "");
  return units ? Number(units[1]) : (numberValue(raw) ?? 0) * diagonal;
}

/** The strokes of a brush on a shape of this diagonal, to be shown. */
export function brushStrokes(text: string, name: string, diagonal: number): Stroke[] {
  return (brushSections(text, name)?.strokes ?? []).map((section) => ({
    radius: worldLength(rawValue(text, section, "radius"), diagonal),
    value: numberValue(rawValue(text, section, "value")) ?? 1,
    hardness: numberValue(rawValue(text, section, "hardness")) ?? 0.5,
    points: pointsOf(arrayValue(rawValue(text, section, "points"))),
  }));
}

/** Takes a brush with its strokes out of the text. */
export function removeBrush(text: string, name: string): string {
  const brush = brushSections(text, name);
  if (!brush) return text;
  const end = (brush.strokes[brush.strokes.length - 1] ?? brush.head).end;
  return replace(text, brush.head.start, end, "");
}

/** How a painted attribute enters a key of the stages: alone, or joined with the formula that is there. */
export interface Use {
  key: string;
  alone: string;
  before: string;
  after: string;
}

/** Makes every stage use a painted attribute. */
export function useInStages(text: string, use: Use): string {
  for (let stage = 0; stage < stageCount(text); ++stage) {
    const raw = stageValue(text, stage, use.key);
    if (raw?.includes(use.alone)) continue;
    const old = stringValue(raw) ?? raw;
    text = setStageKey(text, stage, use.key, quoted(old === null ? use.alone : use.before + old + use.after));
  }
  return text;
}

/** Takes such a use back, as far as it stands there as it was written. */
export function unuseInStages(text: string, use: Use): string {
  for (let stage = 0; stage < stageCount(text); ++stage) {
    const section = stageSection(text, stage);
    const value = stringValue(rawValue(text, section, use.key));
    if (!section || value === null) continue;
    if (value === use.alone) text = removeKey(text, section, use.key);
    else if (value.startsWith(use.before) && value.endsWith(use.after)) {
      text = setKey(text, section, use.key, quoted(value.slice(use.before.length, value.length - use.after.length)));
    }
  }
  return text;
}

/** A model that the recipe holds, and where its own text stands in that of the recipe. */
export interface OwnModel {
  name: string;
  start: number;
  end: number;
}

/** The models of the recipe's own that stand between three quotes of the plain kind, in which nothing is escaped. */
export function ownModels(text: string): OwnModel[] {
  const table = sections(text).find((section) => section.name === "models");
  return (table?.entries ?? []).flatMap(({ key, valueStart, valueEnd }) => {
    if (!text.startsWith("'''", valueStart) || valueEnd - valueStart < 6) return [];
    const lineBreak = /^\r?\n/.exec(text.slice(valueStart + 3))?.[0].length ?? 0;
    return [{ name: key, start: valueStart + 3 + lineBreak, end: valueEnd - 3 }];
  });
}

/** Puts a copy of a model's text into the recipe, and has the stage grow it. */
export function addModel(text: string, stage: number, model: string, modelText: string): { text: string; name: string } {
  const [base, variant] = model.split(":");
  const taken = new Set(ownModels(text).map((one) => one.name));
  let name = `my-${base!.replace(/^my-(.*?)(-\d+)?$/, "$1").replace(/[^A-Za-z0-9_-]/g, "-")}`;
  for (let i = 2; taken.has(name); ++i) name = `${name.replace(/-\d+$/, "")}-${i}`;
  text = setStageKey(text, stage, "model", quoted(variant ? `${name}:${variant}` : name));
  const value = `'''\n${modelText.trimEnd()}\n'''`;
  const table = sections(text).find((section) => section.name === "models");
  if (table) return { text: setKey(text, table, name, value), name };
  return { text: `${text.trimEnd()}\n\n[models]\n${name} = ${value}\n`, name };
}
