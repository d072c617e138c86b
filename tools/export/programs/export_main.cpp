// scree-export: writes the rock of a kept world, of a ground, of a recording's tick or of a running server to
// files of other programs.
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "client/connection/endpoint_options.h"
#include "ground/ground_file.h"
#include "proto/palette_codec.h"
#include "server/app/ground_giver.h"
#include "server/replay/recorded_field.h"
#include "server/store/stored_field.h"
#include "shared/base/distinct_files.h"
#include "shared/base/limits.h"
#include "shared/base/option_check.h"
#include "shared/base/program_output.h"
#include "tools/export/gdal/geotiff_export.h"
#include "tools/export/limits.h"
#include "tools/export/live/live_terrain.h"
#include "tools/export/mesh_export.h"
#include "tools/export/surface_file.h"
#include "tools/export/vdb/vdb_export.h"
#include "tools/export/vox_export.h"
#include "tools/import/programs/program.h"

namespace scree {
namespace {

using Json = nlohmann::ordered_json;
using Progress = std::function<void(double)>;

struct Options {
  std::string from;
  ServerEndpoint server;
  bool live = false;  ///< from the server
  int64_t timeout_s = 600;
  std::string out;
  std::string ground;
  std::optional<Tick> tick;  ///< of a recording
  std::vector<float> box_m;
  std::optional<double> cell_m;
};

/// What is exported.
struct Exported {
  std::unique_ptr<Field> field;
  std::shared_ptr<const Palette> palette;
  ChunkBox box{};
};

/// A recording's terrain after a tick; as of a world, its pieces are no rock of the terrain.
Result<Exported> field_of_recording(const Options& options) {
  const auto giver = TRY(ground_giver(options.from, options.ground));
  const auto source = TRY(ReplaySource::open(options.from, 0, giver));
  auto field = TRY(field_at(options.from, *options.tick, giver));
  return Exported{std::move(field), source->header().world.palette};
}

/// A world's terrain with its edits.
Result<Exported> field_of_world(const Options& options) {
  auto file = TRY(WorldFile::open(options.from));
  TRY(file->hold_moment());
  auto rows = TRY(file->read_moment());
  const auto giver = TRY(ground_giver(options.from, options.ground));
  RecordedHeader& config = rows.world.moment.config;
  if (auto given = give_ground(config.ground, config.terrain, giver); !given)
    return fail(options.from + ": " + given.error().message);
  auto palette = config.palette == nullptr ? shared_builtin_palette() : config.palette;
  auto field = TRY(stored_field(std::move(file), config.terrain, limits::export_bricks_max));
  return Exported{std::move(field), std::move(palette)};
}

Result<Exported> field_of(const Options& options) {
  if (options.tick) return field_of_recording(options);
  if (!options.from.ends_with(".ground")) return field_of_world(options);
  auto file = TRY(GroundFile::open(options.from));
  return Exported{std::make_unique<MapField>(GroundFile::source_of(file)), file->palette()};
}

/// That of --box.
Result<ChunkBox> given_box(const Options& options, float voxel_size_m) {
  const std::vector<float>& m = options.box_m;
  for (size_t axis = 0; axis < 3; ++axis)
    if (!(m[axis] < m[axis + 3]) || !(std::abs(m[axis]) <= 8192.0F) || !(std::abs(m[axis + 3]) <= 8192.0F))
      return fail(
          "--box is x,y,z of its lowest corner, then of its highest, in metres, within 8192 of the origin");
  const ChunkBox box = chunks_of({m[0], m[1], m[2]}, {m[3], m[4], m[5]}, voxel_size_m);
  TRY(check_count(box));
  return box;
}

Result<Exported> read_file(const Options& options) {
  auto what = TRY(field_of(options));
  const auto box =
      options.box_m.empty() ? whole_of(*what.field) : given_box(options, what.field->source().voxel_size_m);
  if (!box) return fail(options.from + ": " + box.error().message);
  if (auto few = check_count(*box); !few) return fail(options.from + ": " + few.error().message);
  what.box = *box;
  return what;
}

Result<Exported> read_server(const Options& options, Json& line) {
  LiveFetch fetch{.server = options.server, .within = std::chrono::seconds(options.timeout_s)};
  if (!options.box_m.empty())
    fetch.box = [&](const Field& field) { return given_box(options, field.source().voxel_size_m); };
  auto terrain = with_bar([&](const Progress& progress) { return fetch_terrain(fetch, progress); });
  TRY(terrain);
  line["tick"] = terrain->tick;
  line["sessions"] = terrain->sessions;
  return Exported{std::move(terrain->field), std::move(terrain->palette), terrain->box};
}

Result<Json> write_vdb(const Options& options, const Exported& what, const Progress& progress) {
  const auto exported = TRY(export_vdb(*what.field, *what.palette, what.box, options.out, progress));
  return Json{{"active_voxels", exported.active_voxels}, {"bytes", exported.bytes}};
}

Result<Json> write_mesh(const Options& options, const Exported& what, const Progress& progress) {
  const auto exported = TRY(export_mesh(*what.field, *what.palette, what.box, options.out, progress));
  Json line{{"points", exported.points},
            {"triangles", exported.triangles},
            {"volume_m3", exported.volume_m3},
            {"bytes", exported.bytes}};
  if (const std::string beside = materials_file_of(options.out); !beside.empty())
    line["materials_file"] = beside;
  return line;
}

Result<Json> write_vox(const Options& options, const Exported& what, const Progress& progress) {
  const auto exported = TRY(export_vox(*what.field, *what.palette, what.box, options.out, progress));
  return Json{{"voxels", exported.voxels},
              {"models", exported.models},
              {"materials", exported.materials},
              {"bytes", exported.bytes}};
}

/// The ground file knows the height that its source has at y = 0; a server does not say it.
Result<Json> write_elevation(const Options& options, const Exported& what, const Progress& progress) {
  GeotiffExport how{.cell_m = options.cell_m};
  if (const auto* file = dynamic_cast<const GroundFile*>(what.field->source().heights.get()))
    how.zero_m = static_cast<double>(file->header().zero_m);
  const auto exported = TRY(export_geotiff(*what.field, what.box, options.out, how, progress));
  return Json{{"columns", exported.grid.columns},
              {"rows", exported.grid.rows},
              {"cell_m", exported.grid.cell_m},
              {"empty_cells", exported.sums.empty_cells},
              {"lowest_m", exported.sums.lowest_m},
              {"highest_m", exported.sums.highest_m},
              {"zero_m", how.zero_m},
              {"volume_m3", exported.sums.volume_m3},
              {"georeference", nullptr},
              {"bytes", exported.bytes}};
}

using Write = Result<Json> (*)(const Options& options, const Exported& what, const Progress& progress);

Write writer_of(const std::string& path) {
  if (path.ends_with(".vdb")) return write_vdb;
  if (path.ends_with(".vox")) return write_vox;
  if (path.ends_with(".tif")) return write_elevation;
  return is_surface_name(path) ? write_mesh : nullptr;
}

Result<void> run(const Options& options) {
  const Write write = writer_of(options.out);
  if (write == nullptr)
    return fail(options.out + ": the name must end in .vdb, .vox, .ply, .obj, .glb or .tif");
  const std::array files{NamedFile{"the exported file", options.from, false, true},
                         NamedFile{"--ground", options.ground}, NamedFile{"--out", options.out, true},
                         NamedFile{"the materials beside --out", materials_file_of(options.out), true}};
  TRY(check_distinct(files));
  if (options.cell_m && write != write_elevation) return fail("--cell is only for elevation models (.tif)");
  Json line{{"file", options.out}};
  if (options.tick) line["tick"] = *options.tick;
  const auto what = options.live ? read_server(options, line) : read_file(options);
  TRY(what);
  line["chunks"] = what->box.count();
  const auto written = with_bar([&](const Progress& progress) -> Result<Json> {
    try {
      return write(options, *what, progress);
    } catch (const ChunkUnreadable& unreadable) {  // of a kept world's file
      return fail(unreadable.what());
    }
  });
  TRY(written);
  line.update(*written);
  // A name of a file may be any bytes.
  std::printf("%s\n", line.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
  return {};
}

void declare(CLI::App& app, Options& options) {
  CLI::Option* from = app.add_option("from", options.from,
                                     "the file of a world, a ground (.ground), or, with --tick, a recording");
  app.get_option("--server")->excludes(from);
  app.add_option("--ground", options.ground,
                 "the ground file of the world; default: found in the world's folder or among all grounds")
      ->needs(from);
  bounded(app.add_option("--tick", options.tick, "export the terrain after this tick of a recording"),
          whole_within(0, whole_most))
      ->needs(from);
  bounded(app.add_option("--timeout", options.timeout_s, "seconds to wait for a server's terrain"),
          whole_within(1, 86400))
      ->needs(app.get_option("--server"))
      ->capture_default_str();
  app.add_option("-o,--out", options.out, "the file to write: .vdb, .vox, .ply, .obj, .glb or .tif")
      ->required()
      ->check(check_replaceable, "FILE");
  app.add_option("--box", options.box_m,
                 "x,y,z,x,y,z of the lowest and the highest corner, metres, rounded to chunks; default: all "
                 "edited terrain, and the whole of a ground that has an end")
      ->delimiter(',')
      ->expected(6);
  app.add_option("--cell", options.cell_m,
                 "metres between the samples of a .tif; default: the size of a voxel")
      ->check(CLI::Range(double{limits::voxel_size_min_m}, 1024.0));
}

}  // namespace
}  // namespace scree

int main(int argc, char** argv) {
  scree::fail_at_file_limit();
  CLI::App app(
      "Exports rock as an OpenVDB level set, MagicaVoxel voxels, a mesh or an elevation model. The rock "
      "comes from a saved "
      "world, a ground, a tick of a recording or a running server.",
      "scree-export");
  app.set_version_flag("--version", SCREE_VERSION);
  scree::Options options;
  scree::EndpointOptions endpoint(app, options.server, "SCREE_TOKEN", scree::EndpointNaming::server);
  scree::declare(app, options);
  if (const auto ended = scree::parse(app, argc, argv)) return *ended;
  options.live = endpoint.names_server();
  const auto completed = endpoint.complete();
  if (!completed || options.live != options.from.empty()) {
    scree::refuse(app, completed
                           ? scree::Error{"name either a file (of a world, ground or recording) or --server"}
                           : completed.error());
    return scree::exit_usage;
  }
  const auto done = scree::run(options);
  return done ? 0 : scree::refuse(app, done.error());
}
