// The compiled module, of which each client has an instance.
const compiled = new Map(); // by address; undefined: the package's own file

/** `wasm`: a WebAssembly.Module, its bytes, an address of them, or undefined. `bytes_of` reads an address. */
export async function load(wasm, bytes_of) {
  if (wasm instanceof WebAssembly.Module) return wasm;
  if (wasm instanceof ArrayBuffer || ArrayBuffer.isView(wasm)) return WebAssembly.compile(wasm);
  const address = wasm === undefined ? undefined : String(wasm);
  if (!compiled.has(address)) {
    const made = Promise.resolve(bytes_of(wasm)).then((bytes) => WebAssembly.compile(bytes));
    compiled.set(address, made);
    made.catch(() => compiled.delete(address)); // another try reads it again
  }
  return compiled.get(address);
}
