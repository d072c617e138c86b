// A client by TCP that joins under any name, as programs do that are not ours, and stays: somebody to be kicked.
import { once } from 'node:events';
import { connect } from 'node:net';

const ACK_MS = 5000;

const varint = (number) => {
  const bytes = [];
  for (let rest = number; ; rest = Math.floor(rest / 128)) {
    if (rest < 128) return Buffer.from([...bytes, rest]);
    bytes.push(rest % 128 + 128);
  }
};
const number_field = (field, number) => Buffer.concat([varint(field * 8), varint(number)]);
const bytes_field = (field, bytes) => Buffer.concat([varint(field * 8 + 2), varint(bytes.length), bytes]);
const framed = (message) => {
  const length = Buffer.alloc(4);
  length.writeUInt32LE(message.length);
  return Buffer.concat([length, message]);
};

/** Joins (Hello of proto/scree.proto). `said`: all bytes of the server's; `ended`: when the server ends the connection. */
export async function visit(port, { name, token = '' }) {
  const socket = connect(port, '127.0.0.1');
  await once(socket, 'connect');
  const text = (field, value) => bytes_field(field, Buffer.from(value));
  const hello = Buffer.concat([number_field(1, 6), text(2, 'visitor'), bytes_field(3, Buffer.alloc(0)), text(5, name), number_field(7, 1), ...(token ? [text(6, token)] : [])]);
  socket.write(framed(bytes_field(1, hello)));
  const visitor = { said: Buffer.alloc(0), ended: once(socket, 'close'), leave: () => socket.destroy() };
  socket.on('error', () => {});
  socket.on('data', (bytes) => { visitor.said = Buffer.concat([visitor.said, bytes]).subarray(-65536); });
  const acks = setInterval(() => socket.write(framed(bytes_field(6, number_field(1, 1)))), ACK_MS);
  visitor.ended.then(() => clearInterval(acks));
  await once(socket, 'data');
  return visitor;
}
