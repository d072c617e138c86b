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
#include "tools/import/files/material_choice.h"
#include "tools/import/files/solid_files.h"
#include "tools/import/gdal/gdal_raster.h"
#include "tools/import/gdal/raster_reader.h"
#include "tools/import/heights_import.h"
#include "tools/import/process/reader_process.h"
#include "tools/import/process/sandbox.h"
#include "tools/import/process/sanitized.h"
#include "tools/import/process/time_limit.h"
#include "tools/import/programs/program.h"

namespace scree {
namespace {

using Json = nlohmann::ordered_json;

/// Bytes of a file's name in words; cut above.
constexpr size_t name_bytes_max = 4096;

struct Options {
  std::vector<std::string> files;
  std::string out;
  std::string preview;
  std::string on;
  MaterialOptions materials;
  std::string sheet = std::string(row_of(SheetRule::refuse).name);
  std::optional<double> level_m;
  std::optional<float> voxel_size_m;
  uint32_t memory_max_mib = 2048;
  double time_max_s = 600.0;
  HeightsImport how;
  RasterChoice raster;
  std::vector<std::string> nodata;
  SolidsImport solids;
  bool has_scale = false;
};

/// Where the file of an elevation model says it wrong or not at all.
void declare_raster(CLI::App& app, Options& options) {
  RasterChoice& choice = options.raster;
  app.add_option("--band", choice.band, "the band of heights, from 1; default: the first, without alpha")
      ->check(CLI::Range(1, 65536));
  app.add_option(
      "--layer", choice.layer,
      "name or number of a raster in a file that has several (netCDF, HDF), or of a file in an archive");
  app.add_option("--crs", choice.crs, "the map, such as EPSG:32633; default: as the file says");
  app.add_option("--vertical-unit", choice.vertical_unit,
                 "unit of the heights: m, ft, us-ft, cm and others; default: as the file says");
  app.add_option("--nodata", options.nodata,
                 "values that stand for no height, besides the file's own; none: all values are heights")
      ->delimiter(',')
      ->allow_extra_args(false);
}

void declare_heights(CLI::App& app, Options& options) {
  HeightsImport& how = options.how;
  app.add_option("--cell", how.cell_m, "metres between the file's rows; default: as the file says")
      ->check(CLI::PositiveNumber);
  app.add_option("--sample", how.sample_m, "metres between the ground's samples; default: as in the file")
      ->check(CLI::PositiveNumber);
  app.add_option("--vertical-scale", how.vertical_scale, "factor that turns the file's heights into metres")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--zero", how.zero_m,
                 "height (after the scale) that becomes y = 0, metres; default: the lowest");
  app.add_option("--fill", how.fill_m,
                 "height (after the scale) where the file has none, metres; default: the lowest");
  app.add_option("--preview", options.preview, "draws a shaded relief to this PNG file");
}

std::string sheet_rules() {
  std::string all;
  for (const SheetRule rule : all_kinds<SheetRule>)
    all += (all.empty() ? "" : ", ") + std::string(row_of(rule).name) + " " + std::string(row_of(rule).means);
  return all;
}

void declare_solids(CLI::App& app, Options& options) {
  SolidsImport& how = options.solids;
  app.add_option("--on", options.on, "ground file on which solids stand; default: level rock");
  app.add_option(
      "--level", options.level_m,
      "height of the level rock, y in metres; default: a voxel above the lowest point of the solids");
  app.add_option("--at", how.place.at_m, "x,y,z of the files' origin in the world, metres; default: 0,0,0")
      ->delimiter(',');
  app.add_option(
         "--scale", how.place.scale,
         "length of the files' unit, metres; of a .vox, of its voxels, by default as those of the world")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--z-up", how.place.z_up, "says that z points up in the files, not y");
  app.add_option("--voxel-size", options.voxel_size_m,
                 "size of a voxel, metres; default: that of the bricks of --on, or 0.25")
      ->check(CLI::Range(limits::voxel_size_min_m, limits::voxel_size_max_m));
  app.add_option(
      "--grid", how.grid,
      "name of the grid in an OpenVDB file; default: its one level set, or else its one grid of floats");
  app.add_option("--density", how.density, "density of a fog volume above which there is rock")
      ->capture_default_str();
  app.add_option("--sheet", options.sheet, "rule for open sheets, as terrain meshes are: " + sheet_rules())
      ->check(
          CLI::IsMember(std::vector<std::string>(kind_names<SheetRule>.begin(), kind_names<SheetRule>.end())))
      ->capture_default_str();
  app.add_option("--material", options.materials.material,
                 "default material, a row of the palette, where the file names none");
  app.add_option("--material-map", options.materials.map,
                 "file with a line NAME-or-NUMBER = material for each material of the files that is to be a "
                 "row of the palette");
  app.add_option("--palette", how.colour_rows_max,
                 "limit of a file's colours that become rows of the palette, where its materials are none of "
                 "it; 0: none do")
      ->check(CLI::Range(0, 255))
      ->capture_default_str();
}

void declare(CLI::App& app, Options& options) {
  app.add_option("file", options.files,
                 "an elevation model (GeoTIFF, ESRI ASCII, 16-bit PNG, or another format of GDAL); or "
                 "solids: OpenVDB (.vdb), MagicaVoxel (.vox) and meshes (.obj, .ply, .stl, .gltf, .glb, "
                 ".off, .dae, .3ds, .fbx)")
      ->required();
  app.add_option("-o,--out", options.out, "the ground file to write")
      ->required()
      ->check(check_replaceable, "FILE");
  app.add_option("--materials", options.materials.palette,
                 "palette (TOML) that materials are rows of; default: that of --on, or the built-in one");
  app.add_option("--soil-below", options.how.soil_below_m,
                 "a metre of soil covers ground below this y, metres; default: all of an elevation model");
  app.add_option("--ice-above", options.how.ice_above_m,
                 "ice covers ground above this y, metres; default: none");
  app.add_option("--memory-max", options.memory_max_mib,
                 "limit of the import's memory, megabytes; a file that needs more is refused")
      ->check(CLI::Range(256, 1 << 20))
      ->capture_default_str();
  app.add_option("--time-max", options.time_max_s,
                 "limit of the time to read a file, and to import solids in all, seconds; what takes longer "
                 "is refused")
      ->check(CLI::Range(0.1, 1e6))
      ->capture_default_str();
  declare_heights(app, options);
  declare_raster(app, options);
  declare_solids(app, options);
}

/// Whatever a library does with a hostile file: memory beyond this is refused to it. Builds with sanitizers
/// do not bound it.
void bound_memory(const Options& options) {
  if (is_sanitized) return;
  const rlim_t bytes = rlim_t{options.memory_max_mib} << 20U;
  const rlimit bound{bytes, bytes};
  setrlimit(RLIMIT_AS, &bound);
}

/// The limits of the processes that read the files.
ReaderLimits reader_limits(const Options& options) {
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

void print(const Options& options, const HeightsImported& imported, const std::optional<Raster::Place>& place,
           double seconds) {
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
Result<RasterChoice> raster_choice_of(const Options& options) {
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

Result<void> run_heights(const Options& options) {
  const auto began = std::chrono::steady_clock::now();
  const std::string& file = options.files.front();
  if (options.files.size() > 1) return fail("only one elevation model can be imported at a time");
  if (!options.on.empty()) return fail(file + ": an elevation model cannot stand on another ground (--on)");
  const auto choice = TRY(raster_choice_of(options));
  const auto materials = TRY(read_choice(options.materials, nullptr));
  HeightsImport how = options.how;
  how.palette = materials.palette;
  auto raster = TRY(open_raster_apart(file, choice, reader_limits(options)));
  const auto imported =
      with_bar([&](const auto& progress) { return import_heights(*raster, options.out, how, progress); });
  say(file, raster->said());
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

void print(const Options& options, const BricksImported& imported, const SolidsRead& read, double seconds) {
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

BricksImport bricks_import_of(const Options& options, float voxel_size_m, std::optional<Material> material,
                              std::shared_ptr<const GroundFile> on, const SolidsRead& read) {
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

Result<void> run_solids(const Options& options) {
  const auto began = std::chrono::steady_clock::now();
  if (!options.preview.empty()) return fail("--preview is only for elevation models");
  std::shared_ptr<const GroundFile> on;
  if (!options.on.empty()) {
    auto file = TRY(GroundFile::open(options.on));
    on = std::move(file);
    if (options.level_m) return fail("--level cannot be used with --on: solids then stand on that ground");
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
  solids.material_map = materials.map;
  solids.material = materials.material;
  if (options.voxel_size_m)
    solids.voxel_size_m = *options.voxel_size_m;
  else if (on != nullptr && on->bricks())
    solids.voxel_size_m = on->bricks()->voxel_size_m;
  const auto read = TRY(read_solids(options.files, solids));
  for (const std::string& said : read.said) std::fprintf(stderr, "scree-import: %s\n", said.c_str());
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
Result<void> check_outputs(const Options& options) {
  std::vector<NamedFile> files{{"--out", options.out, true},
                               {"--preview", options.preview, true},
                               {"--on", options.on},
                               {"--materials", options.materials.palette},
                               {"--material-map", options.materials.map}};
  for (const std::string& file : options.files) files.push_back({"the imported file", file});
  return check_distinct(files);
}

Result<void> run(const Options& options) {
  TRY(check_outputs(options));
  if (const std::string missing = missing_walls(); !missing.empty())
    std::fprintf(stderr, "scree-import: %s\n", missing.c_str());
  bound_memory(options);
  try {
    for (const std::string& file : options.files)
      if (const auto refusal = refusal_of_form(file)) return fail(*refusal);
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
  scree::Options options;
  scree::declare(app, options);
  if (const auto ended = scree::parse(app, argc, argv)) return *ended;
  options.has_scale = app.count("--scale") > 0;
  const auto done = scree::run(options);
  return done ? 0 : scree::refuse(app, done.error());
}
