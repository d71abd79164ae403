/** Messages to and from engines (docs/studio-protocol.md), and the two carriers of them. */

export type Block = Uint8Array | Uint32Array | Float32Array | Float64Array;
export type Blocks = Record<string, Block>;

export interface Message {
  header: Record<string, unknown>;
  blocks: Blocks;
}

interface BlockEntry {
  name: string;
  type: string;
  count: number;
}

const bytesOfType: Record<string, number> = { u8: 1, u32: 4, f32: 4, f64: 8 };
const align = (offset: number): number => (offset + 7) & ~7;

function typeOf(block: Block): string {
  if (block instanceof Uint8Array) return "u8";
  if (block instanceof Uint32Array) return "u32";
  return block instanceof Float32Array ? "f32" : "f64";
}

function view(buffer: ArrayBuffer, type: string, offset: number, count: number): Block {
  if (type === "u8") return new Uint8Array(buffer, offset, count);
  if (type === "u32") return new Uint32Array(buffer, offset, count);
  if (type === "f32") return new Float32Array(buffer, offset, count);
  return new Float64Array(buffer, offset, count);
}

/** The bytes of a message. The page runs on little-endian machines only, as all browsers of today do. */
export function encode(header: Record<string, unknown>, blocks: Blocks = {}): ArrayBuffer {
  const names = Object.keys(blocks);
  const list = names.map((name) => ({ name, type: typeOf(blocks[name]!), count: blocks[name]!.length }));
  const text = new TextEncoder().encode(JSON.stringify(list.length ? { ...header, blocks: list } : header));
  let size = align(4 + text.length);
  for (const name of names) size = align(size + blocks[name]!.byteLength);
  const bytes = new Uint8Array(size);
  new DataView(bytes.buffer).setUint32(0, text.length, true);
  bytes.set(text, 4);
  let offset = align(4 + text.length);
  for (const name of names) {
    const block = blocks[name]!;
    bytes.set(new Uint8Array(block.buffer, block.byteOffset, block.byteLength), offset);
    offset = align(offset + block.byteLength);
  }
  return bytes.buffer;
}

function entries(list: unknown): BlockEntry[] {
  if (list === undefined) return [];
  if (!Array.isArray(list)) throw new Error("the list of blocks is no list");
  return list as BlockEntry[];
}

/** The message that these bytes hold; blocks are views of them. Throws where they are too short or not understood. */
export function decode(buffer: ArrayBuffer): Message {
  if (buffer.byteLength < 4) throw new Error("a message of less than four bytes");
  const length = new DataView(buffer).getUint32(0, true);
  if (4 + length > buffer.byteLength) throw new Error("the header ends beyond the message");
  const parsed: unknown = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  if (typeof parsed !== "object" || parsed === null) throw new Error("the header is no object");
  const header = parsed as Record<string, unknown>;
  const blocks: Blocks = {};
  let offset = align(4 + length);
  for (const entry of entries(header["blocks"])) {
    const width = bytesOfType[entry.type];
    if (!width || !Number.isInteger(entry.count) || entry.count < 0) throw new Error(`block ${entry.name}: unknown type or count`);
    const end = offset + width * entry.count;
    if (end > buffer.byteLength) throw new Error(`block ${entry.name} ends beyond the message`);
    blocks[entry.name] = view(buffer, entry.type, offset, entry.count);
    offset = align(end);
  }
  return { header, blocks };
}

/** A fault that the engine reports, with its place where that is known. */
export class EngineError extends Error {
  readonly fault: string;
  readonly file: string | null;
  readonly line: number | null;
  readonly column: number | null;

  constructor(error: Record<string, unknown>) {
    super(typeof error["message"] === "string" ? error["message"] : "the engine failed without saying why");
    this.fault = typeof error["fault"] === "string" ? error["fault"] : "usage";
    this.file = typeof error["file"] === "string" ? error["file"] : null;
    this.line = typeof error["line"] === "number" ? error["line"] : null;
    this.column = typeof error["column"] === "number" ? error["column"] : null;
  }
}

/** Carries the bytes of a request to an engine and brings those of its reply. */
export interface Carrier {
  send(request: ArrayBuffer): Promise<ArrayBuffer>;
  stop(): void;
}

class NativeCarrier implements Carrier {
  constructor(private readonly token: string) {}

  async send(request: ArrayBuffer): Promise<ArrayBuffer> {
    const response = await this.post("/api", request).catch(() => {
      throw new Error("the program does not answer: is `pelage studio` still running?");
    });
    if (response.status === 403 || response.status === 401) {
      throw new Error("the program refuses this link: open the page by the link that `pelage studio` printed last");
    }
    const type = response.headers.get("content-type") ?? "";
    if (!type.startsWith("application/octet-stream")) throw new Error(`the program answers with HTTP status ${response.status}`);
    return response.arrayBuffer();
  }

  stop(): void {
    void this.post("/stop", null).catch(() => undefined);
  }

  private post(path: string, body: ArrayBuffer | null): Promise<Response> {
    const headers: Record<string, string> = { "X-Pelage-Token": this.token };
    if (body) headers["Content-Type"] = "application/octet-stream";
    return fetch(path, { method: "POST", headers, body, cache: "no-store", credentials: "omit" });
  }
}

class WorkerCarrier implements Carrier {
  private worker: Worker | null = null;
  private waiting: { resolve: (reply: ArrayBuffer) => void; reject: (error: Error) => void } | null = null;

  send(request: ArrayBuffer): Promise<ArrayBuffer> {
    return new Promise((resolve, reject) => {
      this.waiting = { resolve, reject };
      this.start().postMessage(request, [request]);
    });
  }

  /** Requests of this engine are short: there is nothing to stop. */
  stop(): void {}

  private start(): Worker {
    if (this.worker) return this.worker;
    const worker = new Worker(new URL("engine-worker.js", document.baseURI));
    worker.onmessage = (event: MessageEvent<ArrayBuffer>) => this.waiting?.resolve(event.data);
    worker.onerror = (event) => {
      worker.terminate();
      this.worker = null;
      this.waiting?.reject(new Error(`the engine could not be started or has ended${event.message ? `: ${event.message}` : ""}`));
    };
    this.worker = worker;
    return worker;
  }
}

/** The token in the fragment of the page's address, which the native program puts there. */
export function tokenOfAddress(): string | null {
  return new URLSearchParams(location.hash.slice(1)).get("token");
}

export type Answer<T> = T & { blocks: Blocks };

/** The engine, whichever it is. Requests are sent one after the other, in the order of the calls. */
export class Engine {
  private last: Promise<unknown> = Promise.resolve();

  constructor(private readonly carrier: Carrier) {}

  static ofPage(): Engine {
    const token = tokenOfAddress();
    return new Engine(token ? new NativeCarrier(token) : new WorkerCarrier());
  }

  ask<T>(what: string, fields: Record<string, unknown> = {}, blocks: Blocks = {}): Promise<Answer<T>> {
    const reply = this.last.then(() => this.exchange<T>(what, fields, blocks));
    this.last = reply.catch(() => undefined);
    return reply;
  }

  /** Ends the request that is running, where the engine can. */
  stop(): void {
    this.carrier.stop();
  }

  private async exchange<T>(what: string, fields: Record<string, unknown>, blocks: Blocks): Promise<Answer<T>> {
    const message = decode(await this.carrier.send(encode({ do: what, ...fields }, blocks)));
    if (message.header["ok"] !== true) {
      const error = message.header["error"];
      throw new EngineError(typeof error === "object" && error !== null ? (error as Record<string, unknown>) : {});
    }
    return { ...(message.header as T), blocks: message.blocks };
  }
}
