/** Undo and redo: a stack of what was, each with the number under which the engine keeps the coat of that moment. */

import type { View } from "./link";

export interface Snapshot {
  label: string;
  view: View;
  /** What was grown; null where only the view changed. */
  coat: Grown | null;
}

export interface Grown {
  recipe: string;
  shape: string;
  /** Number of the engine's kept state; null where there was no coat. */
  state: Promise<number | null>;
}

const depth = 60;

export class History {
  private readonly past: Snapshot[] = [];
  private readonly future: Snapshot[] = [];
  private merging: { key: string; time: number } | null = null;

  /** Notes what was before a change. Changes with the same key within two seconds are one. */
  record(before: () => Snapshot, mergeKey: string | null = null): void {
    const now = performance.now();
    const merged = mergeKey !== null && this.merging?.key === mergeKey && now - this.merging.time < 2000;
    this.merging = mergeKey === null ? null : { key: mergeKey, time: now };
    if (merged) return;
    this.past.push(before());
    if (this.past.length > depth) this.past.shift();
    this.future.length = 0;
  }

  /** Notes a view that was turned; a look around takes nothing away from what can be redone. */
  recordView(before: Snapshot): void {
    if (this.future.length === 0) this.record(() => before, "view");
  }

  /** `present` tells what is there now, of the same kind as what comes back. */
  undo(present: (wanted: Snapshot) => Snapshot): Snapshot | null {
    return this.move(this.past, this.future, present);
  }

  redo(present: (wanted: Snapshot) => Snapshot): Snapshot | null {
    return this.move(this.future, this.past, present);
  }

  get undoLabel(): string | null {
    return this.past[this.past.length - 1]?.label ?? null;
  }

  get redoLabel(): string | null {
    return this.future[this.future.length - 1]?.label ?? null;
  }

  private move(from: Snapshot[], to: Snapshot[], present: (wanted: Snapshot) => Snapshot): Snapshot | null {
    this.merging = null;
    const wanted = from.pop();
    if (!wanted) return null;
    to.push(present(wanted));
    return wanted;
  }
}
