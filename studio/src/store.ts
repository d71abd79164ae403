/** What a reload must not lose: settings and texts in the local storage, the last file of a shape in IndexedDB. */

import type { View } from "./link";

export interface Saved {
  recipe: string;
  draft: string | null;
  shape: string;
  view: View | null;
  background: string;
  light: number;
  speed: number;
}

const key = "pelage-studio";
const maxFile = 50 * 1024 * 1024;

/** What was saved, each part of it only if it is of the right kind. */
export function load(): Partial<Saved> {
  try {
    const value: unknown = JSON.parse(localStorage.getItem(key) ?? "{}");
    if (typeof value !== "object" || value === null) return {};
    const saved = value as Record<string, unknown>;
    const result: Partial<Saved> = {};
    if (typeof saved["recipe"] === "string") result.recipe = saved["recipe"];
    if (typeof saved["draft"] === "string") result.draft = saved["draft"];
    if (typeof saved["shape"] === "string") result.shape = saved["shape"];
    if (typeof saved["background"] === "string") result.background = saved["background"];
    if (typeof saved["light"] === "number") result.light = saved["light"];
    if (typeof saved["speed"] === "number") result.speed = saved["speed"];
    const view = saved["view"] as View | null | undefined;
    if (view && [view.eye, view.target].every((v) => Array.isArray(v) && v.length === 3 && v.every(Number.isFinite))) {
      result.view = view;
    }
    return result;
  } catch {
    return {};
  }
}

export function save(value: Saved): void {
  try {
    localStorage.setItem(key, JSON.stringify(value));
  } catch {
    // Storage is full or forbidden: then a reload begins anew, which is no reason to stop.
  }
}

function database(): Promise<IDBDatabase> {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open(key, 1);
    request.onupgradeneeded = () => request.result.createObjectStore("files");
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error ?? new Error("no storage"));
  });
}

export interface KeptFile {
  name: string;
  bytes: Uint8Array;
}

/** Keeps the file of a shape for the next load of the page; false where it is too large or cannot be kept. */
export async function keepFile(file: KeptFile): Promise<boolean> {
  if (file.bytes.length > maxFile) return false;
  try {
    const db = await database();
    await new Promise<void>((resolve, reject) => {
      const work = db.transaction("files", "readwrite");
      work.objectStore("files").put(file, "shape");
      work.oncomplete = () => resolve();
      work.onerror = () => reject(work.error ?? new Error("not kept"));
    });
    db.close();
    return true;
  } catch {
    return false;
  }
}

export async function keptFile(): Promise<KeptFile | null> {
  try {
    const db = await database();
    const value = await new Promise<unknown>((resolve, reject) => {
      const request = db.transaction("files").objectStore("files").get("shape");
      request.onsuccess = () => resolve(request.result);
      request.onerror = () => reject(request.error ?? new Error("not read"));
    });
    db.close();
    const file = value as KeptFile | undefined;
    return file && typeof file.name === "string" && file.bytes instanceof Uint8Array ? file : null;
  } catch {
    return null;
  }
}
