// The messages of the protocol (proto/scree.proto) as bytes of its stream, and back. Their code is generated from proto/.
import { create, fromBinary, toBinary } from '@bufbuild/protobuf';
import { PaletteSchema } from 'messages/material_pb.js';
import { ClientMessageSchema, ServerMessageSchema } from 'messages/scree_pb.js';

export { Role } from 'messages/access_pb.js';

export const PROTOCOL = 6;
const LENGTH_BYTES = 4;
/** Of a server's message (proto/limits.h). */
const MESSAGE_BYTES_MAX = 1 << 20;

/** Kinds of messages that the page reads, by their fields in ServerMessage; all others are terrain, bodies and signs of a game. */
const READ = new Set(['welcome', 'refusal', 'reply', 'status', 'adminList', 'content', 'paletteChanged', 'answer', 'regions']
  .map((name) => ServerMessageSchema.field[name].number));

const encoder = new TextEncoder();
const decoder = new TextDecoder();
export const bytes_of = (text) => encoder.encode(text);
export const text_of = (bytes) => decoder.decode(bytes);

/** One message with its length before it. */
export function framed(kind, value) {
  const body = toBinary(ClientMessageSchema, create(ClientMessageSchema, { kind: { case: kind, value } }));
  const bytes = new Uint8Array(LENGTH_BYTES + body.length);
  new DataView(bytes.buffer).setUint32(0, body.length, true);
  bytes.set(body, LENGTH_BYTES);
  return bytes;
}

/** The field that the message begins with: its kind. */
function kind_of(bytes) {
  let number = 0;
  for (let i = 0, shift = 0; i < Math.min(bytes.length, 5); ++i, shift += 7) {
    number |= (bytes[i] & 0x7f) << shift;
    if (bytes[i] < 0x80) return number >>> 3;
  }
  return 0;
}

/** Puts the bytes of a server's stream together again, cut anyhow, and gives out the messages that the page reads. */
export class Stream {
  #bytes = new Uint8Array(0);

  /** Calls `take({case, value})` for each; false: a message is too long, and the stream is at its end. */
  receive(more, take) {
    const all = this.#bytes.length === 0 ? more : joined([this.#bytes, more]);
    let at = 0;
    while (all.length - at >= LENGTH_BYTES) {
      const length = new DataView(all.buffer, all.byteOffset + at).getUint32(0, true);
      if (length > MESSAGE_BYTES_MAX) return false;
      if (all.length - at < LENGTH_BYTES + length) break;
      const message = all.subarray(at + LENGTH_BYTES, at + LENGTH_BYTES + length);
      at += LENGTH_BYTES + length;
      if (!READ.has(kind_of(message))) continue;
      const { kind } = fromBinary(ServerMessageSchema, message);
      if (kind.case) take(kind);
    }
    this.#bytes = all.slice(at);
    return true;
  }
}

export function joined(parts) {
  const all = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

/** The rows of a palette, from the bytes that its digest names: name and colour (three numbers, 0 to 255, as screens have them). */
export function palette_rows(bytes) {
  const for_screen = (linear) => Math.round(255 * Math.min(Math.max(linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055, 0), 1));
  return fromBinary(PaletteSchema, bytes).rows.map(({ name, look }) =>
    ({ name: text_of(name), colour: look ? [look.red, look.green, look.blue].map(for_screen) : null }));
}
