// Puts the administrators' page together: the code of the messages by protoc, and the page's scripts with that and the modules of
// npm as one admin.js. web_dist.mjs gives it to servers, beside the rest of the page.
//   node web_admin.mjs ADMIN_DIR MODULES_DIR PROTO_DIR OUT_DIR
import { execFileSync } from 'node:child_process';
import { cpSync, mkdirSync, readdirSync, rmSync } from 'node:fs';
import { join, resolve } from 'node:path';

const [admin, modules, proto, out] = process.argv.slice(2).map((path) => resolve(path));
const generated = join(out, 'generated');
const messages = join(generated, 'messages');

rmSync(out, { recursive: true, force: true });
mkdirSync(messages, { recursive: true });
const files = readdirSync(proto).filter((name) => name.endsWith('.proto'));
execFileSync('protoc', [`--plugin=${join(modules, '.bin', 'protoc-gen-es')}`, `--proto_path=${proto}`, `--es_out=${messages}`, '--es_opt=target=js,import_extension=js', ...files], { cwd: proto, stdio: 'inherit' });
for (const name of ['admin.html', 'admin.css']) cpSync(join(admin, name), join(out, name));
// The scripts name the messages' code, and that names the modules, as packages: esbuild finds both by this variable.
const env = { ...process.env, NODE_PATH: `${generated}:${modules}` };
execFileSync('esbuild', [join(admin, 'main.js'), '--bundle', '--minify', '--format=esm', '--charset=utf8', '--log-level=warning', `--outfile=${join(out, 'admin.js')}`], { env, stdio: 'inherit' });
rmSync(generated, { recursive: true });
