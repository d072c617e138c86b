// scree-import: makes a ground file of an elevation model, or of solids on a ground.
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "ground/ground_header.h"
#include "shared/base/limits.h"
#include "shared/base/program_output.h"
#include "tools/import/files/solid_files.h"
#include "tools/import/gdal/gdal_raster.h"
#include "tools/import/heights_import.h"
#include "tools/import/process/reader_process.h"
#include "tools/import/programs/program.h"

namespace scree {
namespace {

struct Options {
  std::vector<std::string> files;
  std::string out;
  std::string preview;
  std::string on;
  std::string material;
  std::optional<double> level_m;
  std::optional<float> voxel_size_m;
  uint32_t memory_max_mib = 2048;
  double time_max_s = 600.0;
  HeightsImport how;
  SolidsImport solids;
};

void declare_heights(CLI::App& app, Options& options) {
  HeightsImport& how = options.how;
  app.add_option("--cell", how.cell_m, "metres between the file's samples; unless said, as the file says")
      ->check(CLI::PositiveNumber);
  app.add_option("--sample", how.sample_m, "metres between the ground's samples; unless said, as the file's")
      ->check(CLI::PositiveNumber);
  app.add_option("--vertical-scale", how.vertical_scale, "times the file's heights, metres")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--zero", how.zero_m,
                 "height, after the scale, that becomes y = 0; unless said, the lowest");
  app.add_option("--nodata", how.nodata_m,
                 "height, after the scale, where the file has none; unless said, the lowest");
  app.add_option("--preview", options.preview, "draws a shaded relief to this PNG file");
}

void declare_solids(CLI::App& app, Options& options) {
  SolidsImport& how = options.solids;
  app.add_option("--on", options.on, "solids stand on this ground file; unless said, on level rock");
  app.add_option("--level", options.level_m,
                 "height of the level rock, y; unless said, a voxel above the lowest of the solids");
  app.add_option("--at", how.place.at_m, "x,y,z: where the origin of the files lies in the world, metres")
      ->delimiter(',');
  app.add_option("--scale", how.place.scale, "metres a unit of the files")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--z-up", how.place.z_up, "z points up in the files, not y");
  app.add_option("--voxel-size", options.voxel_size_m,
                 "metres; unless said, that of the bricks of --on, or 0.25")
      ->check(CLI::Range(limits::voxel_size_min_m, limits::voxel_size_max_m));
  app.add_option("--grid", how.grid, "name of the grid in an OpenVDB file; unless said, the first of floats");
  app.add_option("--density", how.density, "rock is where a fog volume is denser")->capture_default_str();
  app.add_option("--material", options.material,
                 "of what no file says it of: " + listed(kind_names<Material>));
}

void declare(CLI::App& app, Options& options) {
  app.add_option(
         "file", options.files,
         "an elevation model (GeoTIFF, ESRI ASCII, 16-bit PNG, whatever GDAL reads); or solids: OpenVDB "
         "(.vdb) and meshes (.obj, .ply, .stl, .gltf, .glb, .off, .dae, .3ds)")
      ->required();
  app.add_option("-o,--out", options.out, "the ground file to write")->required();
  app.add_option("--soil-below", options.how.soil_below_m,
                 "a metre of soil covers ground below this y; unless said, all of an elevation model");
  app.add_option("--ice-above", options.how.ice_above_m, "ice covers ground above this y; unless said, none");
  app.add_option("--memory-max", options.memory_max_mib, "megabytes; a file that needs more is refused")
      ->check(CLI::Range(256, 1 << 20))
      ->capture_default_str();
  app.add_option("--time-max", options.time_max_s, "seconds that a file may be read for; then it is refused")
      ->check(CLI::Range(0.1, 1e6))
      ->capture_default_str();
  declare_heights(app, options);
  declare_solids(app, options);
}

/// Whatever a library does with a hostile file: memory beyond this is refused to it.
void bound_memory(const Options& options) {
  const rlim_t bytes = rlim_t{options.memory_max_mib} << 20U;
  const rlimit bound{bytes, bytes};
  setrlimit(RLIMIT_AS, &bound);
}

/// Of the processes that read the files.
ReaderLimits reader_limits(const Options& options) {
  return {uint64_t{options.memory_max_mib} << 20U,
          std::chrono::milliseconds(static_cast<int64_t>(options.time_max_s * 1000.0))};
}

double seconds_since(std::chrono::steady_clock::time_point began) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

void print(const Options& options, const HeightsImported& imported, double seconds) {
  const HeightLayout& layout = imported.header.ground.layout;
  const nlohmann::ordered_json line{{"ground", options.out},
                                    {"hash", hex_of(name_of(imported.header))},
                                    {"bytes", imported.bytes},
                                    {"columns", layout.columns},
                                    {"rows", layout.rows},
                                    {"sample_m", layout.cell_m},
                                    {"tiles", layout.tiles()},
                                    {"lowest_m", imported.lowest_m},
                                    {"highest_m", imported.highest_m},
                                    {"zero_m", imported.header.zero_m},
                                    {"cells_without_data", imported.nodata},
                                    {"volume_m3", imported.volume_m3},
                                    {"seconds", seconds}};
  std::printf("%s\n", line.dump().c_str());
}

Result<void> run_heights(const Options& options) {
  const auto began = std::chrono::steady_clock::now();
  const std::string& file = options.files.front();
  if (options.files.size() > 1) return fail("of elevation models one at a time is imported");
  if (!options.on.empty()) return fail(file + ": an elevation model stands on no other ground (--on)");
  auto raster = TRY(open_raster(file));
  const auto imported = with_bar(
      [&](const auto& progress) { return import_heights(*raster, options.out, options.how, progress); });
  if (!imported) return fail(file + ": " + imported.error().message);
  if (!options.preview.empty()) {
    const std::vector<uint8_t> pixels = shaded_relief(*imported);
    const int columns = imported->preview_columns;
    const auto written =
        write_grey_png(options.preview, columns, static_cast<int>(pixels.size()) / columns, pixels);
    TRY(written);
  }
  print(options, *imported, seconds_since(began));
  return {};
}

void print(const Options& options, const BricksImported& imported, const SolidsRead& read, double seconds) {
  const BrickLayout& layout = imported.header.ground.bricks->layout;
  const float chunk_m = layout.voxel_size_m * static_cast<float>(chunk_size);
  const auto metres = [&](ChunkCoord at) {
    return std::array{static_cast<float>(at.x) * chunk_m, static_cast<float>(at.y) * chunk_m,
                      static_cast<float>(at.z) * chunk_m};
  };
  nlohmann::ordered_json line{{"ground", options.out},          {"hash", hex_of(name_of(imported.header))},
                              {"bytes", imported.bytes},        {"solids", read.solids.size()},
                              {"chunks", imported.chunks},      {"voxel_size_m", layout.voxel_size_m},
                              {"from_m", metres(layout.lo)},    {"to_m", metres(layout.hi)},
                              {"volume_m3", imported.volume_m3}};
  if (read.meshes_volume_m3 != 0.0) line["meshes_volume_m3"] = read.meshes_volume_m3;
  line["seconds"] = seconds;
  std::printf("%s\n", line.dump().c_str());
}

Result<BricksImport> bricks_import_of(const Options& options, float voxel_size_m,
                                      std::shared_ptr<const GroundFile> on, const SolidsRead& read) {
  BricksImport how{.on = std::move(on), .level_m = options.level_m, .voxel_size_m = voxel_size_m};
  if (!options.material.empty()) {
    how.material = kind_named<Material>(options.material);
    if (!how.material) return fail("--material: '" + options.material + "' is none");
  }
  if (options.how.soil_below_m || options.how.ice_above_m) {
    constexpr auto far_m = static_cast<double>(limits::world_half_height_m);
    how.layers = MaterialHeights{static_cast<float>(options.how.soil_below_m.value_or(-far_m)),
                                 static_cast<float>(options.how.ice_above_m.value_or(far_m))};
  }
  if (!read.exact || (!read.level_m && how.on == nullptr)) return how;
  how.exact = read.exact;
  if (!how.level_m) how.level_m = read.level_m;
  if (!how.layers) how.layers = read.layers;
  return how;
}

Result<void> run_solids(const Options& options) {
  const auto began = std::chrono::steady_clock::now();
  if (!options.preview.empty()) return fail("--preview draws elevation models alone");
  std::shared_ptr<const GroundFile> on;
  if (!options.on.empty()) {
    auto file = TRY(GroundFile::open(options.on));
    on = std::move(file);
    if (options.level_m) return fail("--level is of solids that stand on no ground (--on)");
  }
  SolidsImport solids = options.solids;
  solids.reader = reader_limits(options);
  if (options.voxel_size_m)
    solids.voxel_size_m = *options.voxel_size_m;
  else if (on != nullptr && on->bricks())
    solids.voxel_size_m = on->bricks()->voxel_size_m;
  const auto read = TRY(read_solids(options.files, solids));
  for (const std::string& said : read.said) std::fprintf(stderr, "scree-import: %s\n", said.c_str());
  const auto how = TRY(bricks_import_of(options, solids.voxel_size_m, on, read));
  const auto imported =
      with_bar([&](const auto& progress) { return import_bricks(read.solids, options.out, how, progress); });
  if (!imported) return fail(options.files.front() + ": " + imported.error().message);
  print(options, *imported, read, seconds_since(began));
  return {};
}

Result<void> run(const Options& options) {
  bound_memory(options);
  try {
    const auto solids = std::ranges::count_if(options.files, is_solid_file);
    if (solids == 0) return run_heights(options);
    if (solids < std::ssize(options.files))
      return fail("elevation models and solids are not imported together: solids stand on a ground (--on)");
    return run_solids(options);
  } catch (const std::bad_alloc&) {
    return fail(options.files.front() + ": it does not fit into memory (--memory-max)");
  }
}

}  // namespace
}  // namespace scree

int main(int argc, char** argv) {
  scree::fail_at_file_limit();
  CLI::App app("Makes a ground file of an elevation model or of solids: what scree-server --ground hosts.",
               "scree-import");
  app.set_version_flag("--version", SCREE_VERSION);
  scree::Options options;
  scree::declare(app, options);
  if (const auto ended = scree::parse(app, argc, argv)) return *ended;
  const auto done = scree::run(options);
  return done ? 0 : scree::refuse(app, done.error());
}
