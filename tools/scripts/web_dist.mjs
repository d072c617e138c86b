// Puts the web client together: scree.js, scree.wasm and sound.wasm with the page's files, and the administrators' page where
// web_admin.mjs built it, each under a name that has its content's hash, so that browsers may keep them for ever; pages, whose
// names are in addresses, keep theirs.
// Beside each lies the same compressed, NAME.gz. Where one file names another in quotes ("main.js", './main.js'), the
// name becomes the one with the hash.
//   node web_dist.mjs PAGE_DIR BUILD_DIR OUT_DIR [ADMIN_DIR]
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { mkdirSync, readFileSync, readdirSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { extname, join } from 'node:path';

const [page, build, out, admin] = process.argv.slice(2);
const texts = ['.html', '.css', '.js', '.mjs', '.json', '.svg', '.webmanifest'];
const files = new Map(); // by name: its bytes
// Scripts go without comments and with short names: a third of their bytes.
const small = (script) => execFileSync('esbuild', ['--minify', '--loader=js', '--charset=utf8'], { input: script });
const enter = (folder, name) => {
  const content = readFileSync(join(folder, name));
  files.set(name, extname(name) === '.js' ? small(content) : content);
};
for (const name of readdirSync(page)) enter(page, name);
if (admin) for (const name of readdirSync(admin)) enter(admin, name);
for (const name of ['scree.js', 'scree.wasm', 'sound.wasm']) enter(build, name);

const quoted = (name) => new RegExp(`(["'\`])((?:\\./)?)${name.replace(/[.*+?^${}()|[\]\\]/g, '\\$&')}\\1`, 'g');
const isPage = (name) => extname(name) === '.html';
const isText = (name) => texts.includes(extname(name));
const named = new Map(); // by name: the one with the hash

// What a file names comes first: its name is part of the content.
const done = (name, on = []) => {
  if (named.has(name)) return named.get(name);
  if (on.includes(name)) throw new Error(`these name each other: ${[...on, name].join(', ')}`);
  let content = files.get(name);
  if (isText(name)) {
    let text = content.toString('utf8');
    for (const other of files.keys()) {
      if (other === name || isPage(other) || !quoted(other).test(text)) continue;
      const made = done(other, [...on, name]);
      text = text.replace(quoted(other), (_, quote, here) => `${quote}${here}${made}${quote}`);
    }
    content = Buffer.from(text);
  }
  const hash = createHash('sha256').update(content).digest('hex').slice(0, 12);
  const kind = extname(name);
  const made = isPage(name) ? name : `${name.slice(0, -kind.length)}.${hash}${kind}`;
  files.set(name, content);
  named.set(name, made);
  return made;
};

// Whole, or not at all: a server may be reading the folder.
const partial = `${out}.partial`;
rmSync(partial, { recursive: true, force: true });
mkdirSync(partial, { recursive: true });
let total = 0;
for (const name of [...files.keys()]) {
  const made = done(name);
  const content = files.get(name);
  writeFileSync(join(partial, made), content);
  // Zopfli's files are one twentieth smaller than those of zlib's slowest level, and as fast to unpack.
  const packed = execFileSync('zopfli', ['-c', join(partial, made)], { maxBuffer: 64 * 1024 * 1024 });
  if (packed.length < content.length) writeFileSync(join(partial, `${made}.gz`), packed);
  if (name.startsWith('scree.')) total += Math.min(packed.length, content.length);
  console.log(`${made}: ${content.length} bytes, ${packed.length} compressed`);
}
rmSync(out, { recursive: true, force: true });
renameSync(partial, out);
console.log(`scree.wasm and scree.js: ${Math.round(total / 1024)} KiB compressed`);
const most = 600 * 1024;
if (total > most) throw new Error(`scree.wasm and scree.js are over ${most} bytes, compressed`);
