/**
 * Links that hold a coat: `#s=` and, in base64url, a deflated JSON object of a recipe's text, the name of a built-in shape
 * and a view. Whatever a link holds is checked and bounded before anything is done with it.
 */

export interface View {
  /** Direction from the target to the eye, times its distance in diagonals of the shape. */
  eye: [number, number, number];
  /** The target, from the middle of the box in diagonals. */
  target: [number, number, number];
}

export interface Shared {
  recipe: string;
  shape: string;
  view: View | null;
}

export const maxCompressed = 64 * 1024;
export const maxText = 1024 * 1024;

/** A link that is refused, with the reason in words. */
export class LinkError extends Error {}

function toBase64url(bytes: Uint8Array): string {
  let binary = "";
  for (const byte of bytes) binary += String.fromCharCode(byte);
  return btoa(binary).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}

function fromBase64url(text: string): Uint8Array<ArrayBuffer> {
  if (!/^[A-Za-z0-9_-]*$/.test(text)) throw new LinkError("The link holds characters that no link of the studio has.");
  try {
    return Uint8Array.from(atob(text.replace(/-/g, "+").replace(/_/g, "/")), (c) => c.charCodeAt(0));
  } catch {
    throw new LinkError("The link is cut off or was changed on its way.");
  }
}

async function collect(stream: ReadableStream<Uint8Array>, limit: number): Promise<Uint8Array> {
  const reader = stream.getReader();
  const chunks: Uint8Array[] = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > limit) {
      await reader.cancel().catch(() => undefined);
      throw new LinkError(`The link unpacks to more than ${limit / 1024} kB of text; that is no coat.`);
    }
    chunks.push(value);
  }
  const bytes = new Uint8Array(size);
  let at = 0;
  for (const chunk of chunks) {
    bytes.set(chunk, at);
    at += chunk.length;
  }
  return bytes;
}

function through(bytes: Uint8Array<ArrayBuffer>, stream: CompressionStream | DecompressionStream): ReadableStream<Uint8Array> {
  return new Blob([bytes]).stream().pipeThrough(stream as ReadableWritablePair<Uint8Array, BufferSource>);
}

/** What goes behind `#s=`. Throws a LinkError where it would be too long to be read again. */
export async function encodeLink(shared: Shared): Promise<string> {
  const round = (v: number): number => Number(v.toFixed(4));
  const view = shared.view && { eye: shared.view.eye.map(round), target: shared.view.target.map(round) };
  const text = new TextEncoder().encode(JSON.stringify({ v: 1, recipe: shared.recipe, shape: shared.shape, view }));
  const packed = await collect(through(text as Uint8Array<ArrayBuffer>, new CompressionStream("deflate-raw")), Infinity);
  if (packed.length > maxCompressed || text.length > maxText) {
    throw new LinkError("This coat is too long for a link (64 kB packed): save the recipe as a file instead.");
  }
  return toBase64url(packed);
}

function triple(value: unknown): [number, number, number] | null {
  if (!Array.isArray(value) || value.length !== 3) return null;
  const numbers = value as unknown[];
  return numbers.every((v) => typeof v === "number" && Math.abs(v) <= 100) ? (value as [number, number, number]) : null;
}

function checked(value: unknown): Shared {
  if (typeof value !== "object" || value === null || Array.isArray(value)) throw new LinkError("The link holds no coat.");
  const { v, recipe, shape, view } = value as Record<string, unknown>;
  if (v !== 1) throw new LinkError("The link is of another version of the studio.");
  if (typeof recipe !== "string") throw new LinkError("The link holds no recipe.");
  if (typeof shape !== "string" || !/^builtin:[a-z0-9-]{1,40}(\?[a-z0-9=&.,_-]{0,100})?$/.test(shape)) {
    throw new LinkError("The link names a shape that is not one of the built-in ones.");
  }
  const parts = typeof view === "object" && view !== null ? (view as Record<string, unknown>) : {};
  const eye = triple(parts["eye"]);
  const target = triple(parts["target"]);
  return { recipe, shape, view: eye && target ? { eye, target } : null };
}

/** What a link holds; a LinkError says in words why not. */
export async function decodeLink(text: string): Promise<Shared> {
  if (text.length > Math.ceil((maxCompressed * 4) / 3) + 4) throw new LinkError("The link is longer than 64 kB; that is no coat.");
  const packed = fromBase64url(text);
  let plain: Uint8Array;
  try {
    plain = await collect(through(packed, new DecompressionStream("deflate-raw")), maxText);
  } catch (error) {
    if (error instanceof LinkError) throw error;
    throw new LinkError("The link is cut off or was changed on its way.");
  }
  let value: unknown;
  try {
    value = JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(plain));
  } catch {
    throw new LinkError("The link holds no coat: its text is not understood.");
  }
  return checked(value);
}
