// Says that a client has done its edits, and resolves when the file is there, for all have.
import { existsSync } from 'node:fs';
import { setTimeout as after } from 'node:timers/promises';

export async function all_done(go) {
  console.log('done');
  while (!existsSync(go)) await after(50);
}
