// Edits of a list by a client, in Node and in a page alike.

const AT_REST = 4; // statuses in a row

async function carry_out(client, line) {
  const [kind, shape, ...rest] = line.split(' ');
  const numbers = (count) => rest.splice(0, count).map(Number);
  const edit = { shape, centre: numbers(3) };
  if (shape === 'box') edit.half = numbers(3);
  else [edit.radius] = numbers(1);
  if (kind === 'carve') [edit.seeds, edit.randomSeed] = numbers(2);
  if (kind === 'paint') [edit.material] = rest;
  await client[kind](edit);
}

/** Every STEP-th edit of the text from the FIRST on, one after another; then, once `all_done` resolves, the hash of a world at
 * rest, as 16 digits. */
export async function hash_after(client, text, first, step, all_done) {
  await client.loaded();
  const edits = text.split('\n').filter((line) => line && !line.startsWith('#'));
  for (let i = first; i < edits.length; i += step) await carry_out(client, edits[i]);
  await all_done();
  let quiet = 0, hash = 0n;
  for await (const { kind } of client.events()) {
    if (kind !== 'status') continue;
    const { pieces, serverHash, fieldHash } = client.status();
    quiet = pieces === 0 && serverHash === hash && fieldHash === hash ? quiet + 1 : 0;
    hash = serverHash;
    if (quiet === AT_REST) return hash.toString(16).padStart(16, '0');
  }
  throw new Error('the connection ended');
}
