// The byte stream: a length, then a message; messages by proto/scree.proto, which is read at run time.
import { connect } from 'node:net';

import protobuf from 'protobufjs';

const MESSAGE_BYTES_MAX = 1 << 20;

export class Connection {
  /** `onMessage(kind, content)` for each message of the server; `onEnd(why)` once. */
  constructor({ host, port, proto, onMessage, onEnd }) {
    const root = new protobuf.Root().loadSync(proto, { keepCase: true });
    this.ClientMessage = root.lookupType('scree.wire.ClientMessage');
    this.ServerMessage = root.lookupType('scree.wire.ServerMessage');
    this.onMessage = onMessage;
    this.onEnd = onEnd;
    this.waiting = Buffer.alloc(0);
    this.receivedBytes = 0;
    this.bytesByKind = {};
    this.socket = connect({ host, port, noDelay: true });
    this.socket.on('data', (bytes) => this.receive(bytes));
    this.socket.on('error', (error) => this.end(error.message));
    this.socket.on('close', () => this.end('the server closed the connection'));
  }

  send(kind, content) {
    const body = this.ClientMessage.encode(this.ClientMessage.create({ [kind]: content })).finish();
    const length = Buffer.alloc(4);
    length.writeUInt32LE(body.length);
    this.socket.write(Buffer.concat([length, body]));
  }

  /** A message of a kind that no release has. */
  sendUnknown() {
    this.socket.write(Buffer.from([5, 0, 0, 0, 0xca, 0x3e, 0x02, 0x08, 0x01]));
  }

  receive(bytes) {
    this.receivedBytes += bytes.length;
    this.waiting = Buffer.concat([this.waiting, bytes]);
    try {
      while (this.takeMessage());
    } catch (error) {
      this.end(error.message);
    }
  }

  takeMessage() {
    if (this.waiting.length < 4) return false;
    const length = this.waiting.readUInt32LE(0);
    if (length > MESSAGE_BYTES_MAX) throw new Error(`a message of ${length} bytes`);
    if (this.waiting.length < 4 + length) return false;
    const message = this.ServerMessage.decode(this.waiting.subarray(4, 4 + length));
    this.waiting = this.waiting.subarray(4 + length);
    const kind = message.kind ?? 'unknown'; // of a later version: skipped
    this.bytesByKind[kind] = (this.bytesByKind[kind] ?? 0) + 4 + length;
    if (message.kind) this.onMessage(kind, message[kind]);
    return true;
  }

  end(why) {
    this.socket.destroy();
    this.onEnd?.(why);
    this.onEnd = null;
  }
}
