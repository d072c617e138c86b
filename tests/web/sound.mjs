// sound.wasm makes the samples that the native synthesiser makes, to the bit.
//   node sound.mjs BIN_DIR SOUND_STEPS
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

const SAMPLE_BYTES = 8;

const [bin, program] = process.argv.slice(2);
const { stdout: steps, status } = spawnSync(program, [], { maxBuffer: 64 * 1024 * 1024 });
const { _initialize, memory, sound_events, sound_event_bytes, sound_add, sound_render } = new WebAssembly.Instance(new WebAssembly.Module(readFileSync(join(bin, 'sound.wasm')))).exports;
_initialize();

let at = 0, sounding = 0, frames = 0;
const take = (bytes) => steps.subarray(at, at += bytes);
while (at < steps.length) {
  const count = take(4).readUInt32LE();
  new Uint8Array(memory.buffer).set(take(count * sound_event_bytes()), sound_events());
  sound_add(count);
  const length = take(4).readUInt32LE();
  const wanted = take(length * SAMPLE_BYTES);
  const place = sound_render(length);
  if (Buffer.compare(wanted, Buffer.from(memory.buffer, place, length * SAMPLE_BYTES)) !== 0) {
    console.error(`the samples from ${frames} to ${frames + length} are others`);
    process.exit(1);
  }
  frames += length;
  sounding += wanted.some((byte) => byte !== 0);
}
console.log(`${frames} frames are equal`);
process.exit(status === 0 && sounding > 100 ? 0 : 1);
