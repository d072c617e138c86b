// scree-import: makes a ground file of an elevation model, or of solids on a ground.
#include <array>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "ground/ground_header.h"
#include "ground/whole_file.h"
#include "shared/base/distinct_files.h"
#include "shared/base/limits.h"
#include "shared/base/option_check.h"
#include "shared/base/program_output.h"
#include "shared/base/text.h"
#include "tools/import/file_forms.h"
#include "tools/import/files/cover_files.h"
#include "tools/import/files/material_choice.h"
#include "tools/import/files/solid_files.h"
#include "tools/import/gdal/gdal_raster.h"
#include "tools/import/gdal/raster_reader.h"
#include "tools/import/heights_import.h"
#include "tools/import/option_fit.h"
#include "tools/import/process/reader_process.h"
#include "tools/import/process/sandbox.h"
#include "tools/import/process/sanitized.h"
#include "tools/import/process/time_limit.h"
#include "tools/import/programs/import_options.h"

namespace scree {
namespace {

using Json = nlohmann::ordered_json;

/// Bytes of a file's name in words; cut above.
constexpr size_t name_bytes_max = 4096;

/// Whatever a library does with a hostile file: memory beyond this is refused to it. Builds with sanitizers
/// do not bound it.
void bound_memory(const ImportOptions& options) {
  if (is_sanitized) return;
  const rlim_t bytes = rlim_t{options.memory_max_mib} << 20U;
  const rlimit bound{bytes, bytes};
  setrlimit(RLIMIT_AS, &bound);
}

/// The limits of the processes that read the files.
ReaderLimits reader_limits(const ImportOptions& options) {
  return {uint64_t{options.memory_max_mib} << 20U,
          std::chrono::milliseconds(static_cast<int64_t>(options.time_max_s * 1000.0))};
}

double seconds_since(std::chrono::steady_clock::time_point began) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

/// A name of a file may be any bytes.
void print(const Json& line) {
  std::printf("%s\n", line.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
}

void print(const ImportOptions& options, const HeightsImported& imported,
           const std::optional<Raster::Place>& place, double seconds) {
  const HeightLayout& layout = imported.header.ground.layout;
  Json line{{"ground", options.out},
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
            {"volume_m3", imported.volume_m3}};
  if (place) {
    line["crs"] = place->crs;
    line["middle"] = std::array{place->x, place->y};
  }
  line["seconds"] = seconds;
  print(line);
}

/// With the values of --nodata.
Result<RasterChoice> raster_choice_of(const ImportOptions& options) {
  RasterChoice choice = options.raster;
  for (const std::string& text : options.nodata) {
    if (text == "none") {
      choice.no_nodata = true;
      continue;
    }
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      return fail("--nodata: '" + text + "' is no number, and not none");
    choice.nodata.push_back(value);
  }
  if (choice.no_nodata && !choice.nodata.empty())
    return fail("--nodata none says that all values are heights: it stands alone");
  return choice;
}

void say(const std::string& file, const std::vector<std::string>& sentences) {
  for (const std::string& said : sentences)
    std::fprintf(stderr, "scree-import: %s: %s\n", file.c_str(), said.c_str());
}

Result<void> run_heights(const ImportOptions& options) {
  const auto began = std::chrono::steady_clock::now();
  const std::string& file = options.files.front();
  if (options.files.size() > 1) return fail("only one elevation model can be imported at a time");
  if (options.voxel_size_m && options.cover.raster.empty())
    return fail(file + ": --voxel-size is only for solids and for a cover (--cover): heights have no voxels");
  const auto choice = TRY(raster_choice_of(options));
  const auto materials = TRY(read_choice(options.materials, nullptr));
  HeightsImport how = options.how;
  how.palette = materials.palette;
  auto raster = TRY(open_raster_apart(file, choice, reader_limits(options)));
  std::vector<std::string> said;
  CoverOptions cover = options.cover;
  cover.voxel_size_m = options.voxel_size_m.value_or(cover.voxel_size_m);
  const auto imported = with_bar([&](const auto& progress) {
    return cover.raster.empty() ? import_heights(*raster, options.out, how, progress)
                                : import_covered_heights(*raster, options.out, how, cover,
                                                         reader_limits(options), said, progress);
  });
  say(file, raster->said());
  for (const std::string& sentence : said) std::fprintf(stderr, "scree-import: %s\n", sentence.c_str());
  if (!imported) return fail(file + ": " + imported.error().message);
  if (!options.preview.empty()) {
    const std::vector<uint8_t> pixels = shaded_relief(*imported);
    const int columns = imported->preview_columns;
    const auto written =
        write_grey_png(options.preview, columns, static_cast<int>(pixels.size()) / columns, pixels);
    TRY(written);
  }
  say(file, imported->said);
  print(options, *imported, raster->place(), seconds_since(began));
  return {};
}

void print(const ImportOptions& options, const BricksImported& imported, const SolidsRead& read,
           double seconds) {
  const BrickLayout& layout = imported.header.ground.bricks->layout;
  const float chunk_m = layout.voxel_size_m * static_cast<float>(chunk_size);
  const auto metres = [&](ChunkCoord at) {
    return std::array{static_cast<float>(at.x) * chunk_m, static_cast<float>(at.y) * chunk_m,
                      static_cast<float>(at.z) * chunk_m};
  };
  Json line{{"ground", options.out},          {"hash", hex_of(name_of(imported.header))},
            {"bytes", imported.bytes},        {"solids", read.solids.size()},
            {"chunks", imported.chunks},      {"voxel_size_m", layout.voxel_size_m},
            {"from_m", metres(layout.lo)},    {"to_m", metres(layout.hi)},
            {"volume_m3", imported.volume_m3}};
  line["materials"] = read.palette->rows.size();
  if (read.meshes_volume_m3 != 0.0) line["meshes_volume_m3"] = read.meshes_volume_m3;
  line["seconds"] = seconds;
  print(line);
}

BricksImport bricks_import_of(const ImportOptions& options, float voxel_size_m,
                              std::optional<Material> material, std::shared_ptr<const GroundFile> on,
                              const SolidsRead& read) {
  BricksImport how{.on = std::move(on),
                   .level_m = options.level_m,
                   .voxel_size_m = voxel_size_m,
                   .palette = read.palette,
                   .material = material};
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

Result<void> run_solids(const ImportOptions& options) {
  const auto began = std::chrono::steady_clock::now();
  std::shared_ptr<const GroundFile> on;
  if (!options.on.empty()) {
    auto file = TRY(GroundFile::open(options.on));
    on = std::move(file);
    if (options.level_m) return fail("--level cannot be used with --on: solids then stand on that ground");
    if (options.how.soil_below_m || options.how.ice_above_m)
      return fail("--soil-below and --ice-above cannot be used with --on: that ground has its own layers");
  }
  SolidsImport solids = options.solids;
  solids.reader = reader_limits(options);
  solids.has_scale = options.has_scale;
  const TimeLimit time_limit(solids.reader.time,
                             fmt::format("scree-import: {}: the import did not finish within {:.6g} s "
                                         "(--time-max): bad places of a mesh may "
                                         "make it large, and larger voxels make less work (--voxel-size)",
                                         showable(options.files.front(), name_bytes_max), options.time_max_s),
                             unfinished_name(options.out));
  solids.sheet = kind_named<SheetRule>(options.sheet).value_or(SheetRule::refuse);
  solids.level_m = options.level_m;
  const auto materials = TRY(read_choice(options.materials, on.get()));
  for (const std::string& said : materials.said) std::fprintf(stderr, "scree-import: %s\n", said.c_str());
  solids.palette = materials.palette;
  solids.material_map = map_of(materials.map);
  solids.material = materials.material;
  if (options.voxel_size_m)
    solids.voxel_size_m = *options.voxel_size_m;
  else if (on != nullptr && on->bricks())
    solids.voxel_size_m = on->bricks()->voxel_size_m;
  const auto read = TRY(read_solids(options.files, solids));
  for (const std::string& said : read.said) std::fprintf(stderr, "scree-import: %s\n", said.c_str());
  for (const std::string& said : words_on_unused(options.materials.map, materials.map, read.map_used))
    std::fprintf(stderr, "scree-import: %s\n", said.c_str());
  auto how = bricks_import_of(options, solids.voxel_size_m, materials.material, on, read);
  how.least_m3 = least_volume_m3(read);
  const auto imported =
      with_bar([&](const auto& progress) { return import_bricks(read.solids, options.out, how, progress); });
  if (!imported) return fail(options.files.front() + ": " + imported.error().message);
  if (const auto words = words_on_difference(read, imported->volume_m3))
    std::fprintf(stderr, "scree-import: %s\n", words->c_str());
  print(options, *imported, read, seconds_since(began));
  return {};
}

/// Writing over a file that is read would lose it.
Result<void> check_outputs(const ImportOptions& options) {
  std::vector<NamedFile> files{{"--out", options.out, true},
                               {"--preview", options.preview, true},
                               {"--on", options.on},
                               {"--materials", options.materials.palette},
                               {"--material-map", options.materials.map},
                               {"--cover", options.cover.raster},
                               {"--cover-map", options.cover.map}};
  for (const std::string& file : options.files) files.push_back({"the imported file", file});
  return check_distinct(files);
}

Result<void> run(const ImportOptions& options) {
  TRY(check_outputs(options));
  if (const std::string missing = missing_walls(); !missing.empty())
    std::fprintf(stderr, "scree-import: %s\n", missing.c_str());
  bound_memory(options);
  try {
    for (const std::string& file : options.files)
      if (const auto refusal = refusal_of_form(file)) return fail(*refusal);
    TRY(check_options_fit(options.given, options.files));
    const auto solids = std::ranges::count_if(options.files, is_solid_file);
    if (solids == 0) return run_heights(options);
    if (solids < std::ssize(options.files))
      return fail(
          "elevation models and solids cannot be imported together: import the model first, then the solids "
          "with --on");
    return run_solids(options);
  } catch (const std::bad_alloc&) {
    return fail(options.files.front() + ": it does not fit into memory (--memory-max)");
  }
}

}  // namespace
}  // namespace scree

int main(int argc, char** argv) {
  scree::fail_at_file_limit();
  CLI::App app("Makes a ground file for scree-server --ground, from an elevation model or from solids.",
               "scree-import");
  app.set_version_flag("--version", SCREE_VERSION);
  scree::ImportOptions options;
  scree::declare(app, options);
  if (const auto ended = scree::parse(app, argc, argv)) return *ended;
  options.has_scale = app.count("--scale") > 0;
  for (const CLI::Option* const option : app.get_options())
    if (option->count() > 0) options.given.push_back(option->get_name());
  const auto done = scree::run(options);
  return done ? 0 : scree::refuse(app, done.error());
}
