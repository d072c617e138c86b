// Puts the npm package scree-client together, and packs it by `npm pack`: the scripts of client/web/package, what the build
// made of the C interface, and the version that CMake has.
//   node web_package.mjs PACKAGE_DIR BUILD_DIR CMAKE_LISTS OUT_DIR
// OUT_DIR gets package/, as it is unpacked, and where npm is installed scree-client-VERSION.tgz. It fails where what a page
// fetches is too large.
import { execFileSync, spawnSync } from 'node:child_process';
import { cpSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { brotliCompressSync, constants } from 'node:zlib';

const [scripts, build, lists, out] = process.argv.slice(2).map((path) => resolve(path));
const BYTES_MAX = 400 * 1024;
const folder = join(out, 'package');

const version = /project\(scree VERSION ([0-9.]+)/.exec(readFileSync(lists, 'utf8'))[1];
rmSync(out, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
cpSync(scripts, folder, { recursive: true });
cpSync(join(build, 'package', 'layout.js'), join(folder, 'layout.js'));
cpSync(join(build, 'bin', 'scree_client.wasm'), join(folder, 'scree_client.wasm'));
const about = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
writeFileSync(join(folder, 'package.json'), `${JSON.stringify({ ...about, version }, null, 2)}\n`);

// As servers send it: by Brotli, which every browser takes, or by gzip.
const brotli = (bytes) => brotliCompressSync(bytes, { params: { [constants.BROTLI_PARAM_LGWIN]: constants.BROTLI_MAX_WINDOW_BITS } }).length;
let total = 0, by_gzip = 0;
for (const name of readdirSync(folder).filter((each) => /\.(js|wasm)$/.test(each))) {
  const bytes = readFileSync(join(folder, name));
  const packed = brotli(bytes), gzip = execFileSync('zopfli', ['-c', join(folder, name)], { maxBuffer: 64 * 1024 * 1024 }).length;
  total += packed;
  by_gzip += gzip;
  console.log(`${name}: ${bytes.length} bytes, ${packed} by Brotli, ${gzip} by gzip`);
}
console.log(`scree-client ${version}: ${Math.round(total / 1024)} KiB by Brotli, ${Math.round(by_gzip / 1024)} by gzip`);
if (total > BYTES_MAX) throw new Error(`the package's code is ${total} bytes by Brotli: over ${BYTES_MAX}`);

// npm's own folder for what it keeps, so that it needs no home and no network.
const npm = ['pack', '--pack-destination', out, '--ignore-scripts', '--offline', '--silent', '--cache', join(out, '.npm')];
const { error, status } = spawnSync('npm', npm, { cwd: folder, stdio: ['ignore', 'ignore', 'inherit'] });
if (error?.code === 'ENOENT') console.log('npm is not installed (./scree setup --tests): the package is not packed');
else if (error || status !== 0) throw new Error(`npm pack ended with ${error ?? status}`);
rmSync(join(out, '.npm'), { recursive: true, force: true });
