// Carries out every STEP-th edit of a list (tests/library/edits.txt) from the FIRST on, and prints the hash of all edits that
// the copy has in the end, as tests/library/same_edits.c does.
//   node same_edits.js PORT LIST FIRST STEP GO
import { readFileSync } from 'node:fs';

import { connect } from 'scree-client';

import { all_done } from './all_done.js';
import { hash_after } from './carried_out.js';

const [port, list, first, step, go] = process.argv.slice(2);
const client = await connect(`ws://127.0.0.1:${port}`, { once: true, program: 'same-edits' });
console.log(await hash_after(client, readFileSync(list, 'utf8'), Number(first), Number(step), () => all_done(go)));
await client.close();
