// The engine of the studio in a worker: a request comes as an ArrayBuffer and is answered with one, in their order
// (docs/studio-protocol.md). pelage-engine.js and pelage-engine.wasm lie beside this file.
"use strict";

/** A reply that says what went wrong here. */
function failure(message) {
  const header = new TextEncoder().encode(JSON.stringify({ ok: false, error: { fault: "numerics", message } }));
  const reply = new ArrayBuffer(Math.ceil((4 + header.length) / 8) * 8);
  new DataView(reply).setUint32(0, header.length, true);
  new Uint8Array(reply).set(header, 4);
  return reply;
}

/** The module, or a promise that fails in words. */
async function start() {
  try {
    importScripts("pelage-engine.js");
    return await createPelageEngine();
  } catch (fault) {
    throw new Error(`the engine could not be loaded (${fault.message ?? fault}); try again, or take another browser`);
  }
}

/** The memory of the module may move whenever it is called, and its addresses have no sign. */
function answer(engine, request) {
  const place = engine._pelage_request(request.byteLength) >>> 0;
  engine.HEAPU8.set(new Uint8Array(request), place);
  const size = engine._pelage_handle() >>> 0;
  const reply = engine._pelage_reply() >>> 0;
  return engine.HEAPU8.slice(reply, reply + size).buffer;
}

const started = start();
started.catch(() => {}); // every request is told
let ended = "";

self.onmessage = async ({ data }) => {
  let reply;
  try {
    const engine = await started;
    reply = ended ? failure(ended) : answer(engine, data);
  } catch (fault) {
    if (fault instanceof WebAssembly.RuntimeError) ended = "the engine has stopped; load the page again";
    reply = failure(ended || fault.message);
  }
  self.postMessage(reply, [reply]);
};
