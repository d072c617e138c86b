// The tables that functions take and give. Those that are read by rows of fields (fields.h) are described by
// these rows; the others stand here, beside who writes them in words.
#include "server/rules/api.h"
#include "server/rules/api/build.h"
#include "server/rules/api/joint_fields.h"
#include "server/rules/api/query_fields.h"
#include "server/rules/request_table.h"

namespace scree {

namespace {

constexpr ApiType written_types[] = {
    {"vec", "x: number\ny: number\nz: number",
     "A place, a direction or a speed; y is up, metres. Made by `vec(1, 2, 3)` or `vec{1, 2, 3}`; with +, -, "
     "*, /, ==, :length(), :unit(), :dot(b), :cross(b) and :distance(b). Functions also take {1, 2, 3} and "
     "{x = "
     "1, y = 2, z = 3}."},
    {"turn",
     "x?: number\ny?: number\nz?: number\nw?: number\naxis?: vec -- of {axis =, degrees =}; upright as "
     "usual\n"
     "degrees?: number -- counterclockwise as seen against the axis",
     "How something is turned: a quaternion x, y, z, w, or degrees about an axis."},
    {"material", "", "The name of a material, such as \"rock\", or its number."},
    {"store",
     "token?: string -- of a person with an access token who is not here\n"
     "session?: integer -- of another one",
     "Whose rock it is: \"world\", a person, or the name of a store, such as \"red\"."},
    {"reply",
     "done: boolean -- whether it was carried out\nrefusal?: string -- else why not\n"
     "reason?: string -- the refusal's name, which stays the same from version to version\n"
     "pieces: integer -- that were made\nbody?: body -- that was added\njoint?: joint -- likewise\n"
     "volume?: number -- m³ that were dug, placed or transferred",
     "What became of a request, some ticks after it."},
    {"hit",
     "kind: string -- terrain, piece, prop or person\nat: vec -- on what was hit\n"
     "normal: vec -- of length 1, away from it\ndistance: number -- that it went, metres\n"
     "inside: boolean -- it began inside: distance 0\nbody?: body -- of all but terrain\n"
     "person?: person -- whose body it is\nmaterial?: string -- of terrain and pieces",
     "What a ray or a ball met."},
    {"overlap", "terrain: boolean\nbodies: body[]", "What has a place within a ball or a box."},
    {"sign_options",
     "to?: person|string -- for whom: a person, or a team by its name; nil: for all\n"
     "colour?: string -- \"#rrggbb\"\nlasts?: number -- seconds until it ends by itself\n"
     "counts?: boolean -- whether the time that is left stands after the text",
     "How a sign is shown."},
    {"cue_options",
     "size?: number -- metres across, of what sounds or of the puff: up to 16\n"
     "energy?: number -- joules: how loud, or how much\nmaterial?: material\nto?: person|string",
     "How a cue sounds or looks."},
    {"ledger_row",
     "terrain: number -- gain since the start\npieces: number\ndust: number\npoured: number -- in\n"
     "stored: number",
     "Where rock is, m³: terrain + pieces + dust + stored = poured, but for what paints made of it."},
    {"region_mass",
     "by?: person -- who broke it out\nmaterial: string\ncut: number -- the sum of the rest\n"
     "pieces: number\ndust: number\ncarried: number -- in stores\nback: number -- in the region again\n"
     "away: number -- terrain elsewhere",
     "What became of rock of a region, m³."},
};

std::string lines_of(const FieldTable& fields) {
  std::string lines;
  for (const FieldRow& row : fields.rows) {
    const bool needed = row.needed && row.applies == nullptr;
    lines += (lines.empty() ? "" : "\n") + std::string(row.name) + (needed ? ": " : "?: ") +
             std::string(row.type) + " -- " + std::string(row.what);
  }
  return lines;
}

/// The types that rows of fields describe, whose texts it holds.
struct TypesOfFields {
  std::vector<std::string> texts;
  std::vector<ApiType> types;

  TypesOfFields() {
    types.assign(std::begin(written_types), std::end(written_types));
    std::vector<const FieldTable*> tables(request_field_tables().begin(), request_field_tables().end());
    tables.insert(tables.end(), {&wanted_joint_fields, &build_fields, &mask_fields});
    texts.reserve(tables.size());  // types view them
    for (const FieldTable* const table : tables)
      types.push_back({table->name, texts.emplace_back(lines_of(*table)), table->what});
  }
};

}  // namespace

std::span<const ApiType> api_types() {
  static const TypesOfFields all;
  return all.types;
}

}  // namespace scree
