// From the header of the C interface to what the npm package knows of it: where members of structs lie in the memory of
// WebAssembly (pointers of 32 bits), and the values of its constants. A line that this does not understand is an error.
//   node client_layout.mjs HEADER LAYOUT_JS CHECK_CPP
// LAYOUT_JS: an ES module that exports `structs`, by name { size, members: by name { at, type, count } }, `values`, the
// constants by name, and `enums`, by name the constants of each. CHECK_CPP: a source that compiles only where the compiler finds the same.
import { readFileSync, writeFileSync } from 'node:fs';

const [header, script, check] = process.argv.slice(2);
const text = readFileSync(header, 'utf8').replace(/\/\*[\s\S]*?\*\//g, '');
const parts = (list, at) => list.split(at).map((part) => part.replace(/\s+/g, ' ').trim()).filter(Boolean);

const SIZES = { int8_t: 1, uint8_t: 1, int32_t: 4, uint32_t: 4, int64_t: 8, uint64_t: 8, float: 4, double: 8, size_t: 4 };
const structs = {}, values = {}, enums = {};

/** { type, bytes, align } of a member's type. */
const typeOf = (name) => {
  if (name === 'const char*') return { type: 'text', bytes: 4, align: 4 };
  if (name.endsWith('*')) return { type: 'pointer', bytes: 4, align: 4 };
  if (name === 'size_t') return { type: 'uint32', bytes: 4, align: 4 };
  if (SIZES[name]) return { type: name.replace('_t', ''), bytes: SIZES[name], align: SIZES[name] };
  if (structs[name]) return { type: name, bytes: structs[name].size, align: structs[name].align };
  throw new Error(`${header}: the type ${name} is not known`);
};

/** The members that a line declares: their names, and how their types are written. */
const membersOf = (line) => {
  const call = /^[\w* ]+\(\*(\w+)\)\(.*\)$/.exec(line);
  if (call) return [{ name: call[1], written: 'void*', count: 1 }];
  const first = /^((?:const )?\w+) ?(.*)$/.exec(line);
  return parts(first?.[2] ?? '', ',').map((part) => {
    const plain = /^(\*?) ?(\w+)(?:\[(\d+)\])?$/.exec(part);
    if (!plain) throw new Error(`${header}: the member "${line}" is not understood`);
    return { name: plain[2], written: first[1] + plain[1], count: Number(plain[3] ?? 1) };
  });
};

for (const [, name, body] of text.matchAll(/typedef struct (\w+) \{([\s\S]*?)\} \w+;/g)) {
  const members = {};
  let at = 0, widest = 1;
  for (const member of parts(body, ';').flatMap(membersOf)) {
    const { type, bytes, align } = typeOf(member.written);
    at = Math.ceil(at / align) * align;
    members[member.name] = { at, type, count: member.count };
    at += bytes * member.count;
    widest = Math.max(widest, align);
  }
  structs[name] = { size: Math.ceil(at / widest) * widest, align: widest, members };
}

for (const [, name, body] of text.matchAll(/\benum(?: (\w+))? \{([\s\S]*?)\}/g)) {
  let next = 0;
  for (const part of parts(body, ',')) {
    const row = /^(SCREE_\w+)(?: = (?:(-?\d+)|1 << (\d+)))?$/.exec(part);
    if (!row) throw new Error(`${header}: the constant "${part}" is not understood`);
    if (row[2] !== undefined) next = Number(row[2]);
    if (row[3] !== undefined) next = 2 ** Number(row[3]);
    values[row[1]] = next;
    if (name) (enums[name] ??= {})[row[1]] = next;
    ++next;
  }
}
for (const [, name, value] of text.matchAll(/#define (SCREE_\w+) (0x[0-9A-Fa-f]+|\d+)U?\n/g)) values[name] = Number(value);

const bare = Object.fromEntries(Object.entries(structs).map(([name, { size, members }]) => [name, { size, members }]));
writeFileSync(script, `// Made of scree/client.h.\nexport const structs = ${JSON.stringify(bare)};\nexport const values = ${JSON.stringify(values)};\n` +
  `export const enums = ${JSON.stringify(enums)};\n`);

const lines = ['// Made of scree/client.h: where the package takes members to lie.', '#include <cstddef>', '', '#include "client/library/include/scree/client.h"', ''];
for (const [name, { size, members }] of Object.entries(structs)) {
  lines.push(`static_assert(sizeof(${name}) == ${size});`);
  for (const [member, { at }] of Object.entries(members)) lines.push(`static_assert(offsetof(${name}, ${member}) == ${at});`);
}
for (const [name, value] of Object.entries(values)) lines.push(`static_assert(static_cast<long long>(${name}) == ${value});`);
writeFileSync(check, `${lines.join('\n')}\n`);
