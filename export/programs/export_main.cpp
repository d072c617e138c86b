// scree-export: writes the rock of a kept world or of a ground to files of other programs.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "export/limits.h"
#include "export/mesh_export.h"
#include "export/vdb/vdb_export.h"
#include "ground/ground_file.h"
#include "import/progress_bar.h"
#include "server/app/ground_giver.h"
#include "server/store/world_file.h"

namespace scree {
namespace {

constexpr int failed = 1;
constexpr int usage_error = 2;

struct Options {
  std::string from;
  std::string out;
  std::string ground;
  std::vector<float> box_m;
};

int refuse(const Error& error) {
  std::fprintf(stderr, "scree-export: %s\n", error.message.c_str());
  return failed;
}

/// A world's terrain with its edits. Its pieces are no rock of the terrain.
Result<std::unique_ptr<Field>> field_of_world(const Options& options) {
  const auto file = WorldFile::open(options.from);
  if (!file) return tl::unexpected(file.error());
  auto rows = (*file)->read();
  if (!rows) return tl::unexpected(rows.error());
  const auto giver = ground_giver(options.from, options.ground);
  if (!giver) return tl::unexpected(giver.error());
  RecordedHeader& config = rows->world.moment.config;
  if (auto given = give_ground(config.ground, config.terrain, *giver); !given)
    return fail(options.from + ": " + given.error().message);
  auto field = std::make_unique<MapField>(config.terrain);
  for (const BrickPatch& brick : rows->world.bricks) {
    field->set_brick(brick.coord, brick.brick);
    field->paint_brick(brick.coord, brick.paint);
  }
  return field;
}

Result<std::unique_ptr<Field>> field_of(const Options& options) {
  if (!options.from.ends_with(".ground")) return field_of_world(options);
  auto file = GroundFile::open(options.from);
  if (!file) return tl::unexpected(file.error());
  TerrainSource source;
  source.heights = *file;
  if (const auto& bricks = (*file)->bricks()) source.voxel_size_m = bricks->voxel_size_m;
  return std::make_unique<MapField>(source);
}

Result<ChunkBox> box_of(const Options& options, const Field& field) {
  auto box = whole_of(field);
  if (!options.box_m.empty()) {
    const std::vector<float>& m = options.box_m;
    for (size_t axis = 0; axis < 3; ++axis)
      if (!(m[axis] < m[axis + 3]) || !(std::abs(m[axis]) <= 8192.0F) || !(std::abs(m[axis + 3]) <= 8192.0F))
        return fail("--box is x,y,z of its lowest corner, then of its highest, in metres");
    box = chunks_of({m[0], m[1], m[2]}, {m[3], m[4], m[5]}, field.source().voxel_size_m);
  }
  if (box && box->count() > limits::export_chunks_max)
    return fail("more than " + std::to_string(limits::export_chunks_max) +
                " chunks (limits.export_chunks_max): --box makes them fewer");
  return box;
}

int run(const Options& options) {
  const bool is_vdb = options.out.ends_with(".vdb");
  if (!is_vdb && !is_mesh_name(options.out))
    return refuse({options.out + ": files of .vdb, .ply and .obj can be written"});
  const auto field = field_of(options);
  if (!field) return refuse(field.error());
  const auto box = box_of(options, **field);
  if (!box) return refuse({options.from + ": " + box.error().message});
  ProgressBar bar;
  const auto progress = [&](double part) { bar.show(part); };
  nlohmann::ordered_json line{{"file", options.out}, {"chunks", box->count()}};
  if (is_vdb) {
    const auto exported = export_vdb(**field, *box, options.out, progress);
    bar.end();
    if (!exported) return refuse(exported.error());
    line["active_voxels"] = exported->active_voxels;
    line["bytes"] = exported->bytes;
  } else {
    const auto exported = export_mesh(**field, *box, options.out, progress);
    bar.end();
    if (!exported) return refuse(exported.error());
    line["points"] = exported->points;
    line["triangles"] = exported->triangles;
    line["volume_m3"] = exported->volume_m3;
    line["bytes"] = exported->bytes;
  }
  std::printf("%s\n", line.dump().c_str());
  return 0;
}

}  // namespace
}  // namespace scree

int main(int argc, char** argv) {
  CLI::App app("Writes the rock of a kept world or of a ground as an OpenVDB level set or as a mesh.",
               "scree-export");
  app.set_version_flag("--version", SCREE_VERSION);
  scree::Options options;
  app.add_option("from", options.from, "the file of a world, or a ground (.ground)")->required();
  app.add_option("--ground", options.ground,
                 "the ground file of the world; unless said, looked for beside it and among all grounds");
  app.add_option("-o,--out", options.out, "the file to write: .vdb, .ply or .obj")->required();
  app.add_option(
         "--box", options.box_m,
         "x,y,z,x,y,z: the lowest and the highest corner, metres, rounded to chunks; unless said, all that "
         "was edited and all of a ground that ends")
      ->delimiter(',')
      ->expected(6);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : scree::usage_error;
  }
  return scree::run(options);
}
