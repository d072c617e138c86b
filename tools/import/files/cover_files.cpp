#include "tools/import/files/cover_files.h"

#include <charconv>
#include <filesystem>
#include <fmt/format.h>

#include "ground/whole_file.h"
#include "shared/base/text.h"
#include "tools/import/gdal/raster_reader.h"

namespace scree {

namespace {

/// A file that is removed at the end.
class PassingFile {
 public:
  explicit PassingFile(std::string path) : path_(std::move(path)) {}
  ~PassingFile() {
    std::error_code error;
    std::filesystem::remove(path_, error);
  }
  PassingFile(const PassingFile&) = delete;
  PassingFile& operator=(const PassingFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Classes are numbers that a raster's cell can hold as they are.
Result<MaterialMap> read_classes(const std::string& path, const Palette& palette) {
  constexpr int64_t most = int64_t{1} << 53;
  MaterialMap classes;
  for (const MapLine& line : TRY(read_map_lines(path, palette))) {
    int64_t number = 0;
    const char* const end = line.name.data() + line.name.size();
    const auto [at, error] = std::from_chars(line.name.data(), end, number);
    if (error != std::errc() || at != end || number < -most || number > most)
      return fail(fmt::format("{}:{}: '{}' is no class of a raster: a class is a whole number within ± 2^53",
                              path, line.number, showable(line.name, 80)));
    if (!classes.emplace(std::to_string(number), line.material).second)
      return fail(fmt::format("{}:{}: class {} stands in a line before", path, line.number, number));
  }
  return classes;
}

/// Numbers of classes are stored as heights would be, without a unit, and any may be one.
Result<CoverGrid> grid_in(const CoverOptions& cover, Raster& model, const HeightsImport& how,
                          const ReaderLimits& bounds, std::vector<std::string>& said) {
  const MaterialMap classes = TRY(read_classes(cover.map, *how.palette));
  const RasterChoice choice{.band = 1, .vertical_unit = "m"};
  const auto raster = TRY(open_raster_apart(cover.raster, choice, bounds));
  const auto wrong = [&](const Error& error) { return fail(cover.raster + ": " + error.message); };
  if (const auto same = check_same_place(*raster, model, how.cell_m); !same) return wrong(same.error());
  auto grid = read_cover(*raster, classes);
  if (!grid) return wrong(grid.error());
  if (grid->without > 0)
    said.push_back(fmt::format("{}: {} of {} cells have no class of --cover-map: there the layers stay",
                               cover.raster, grid->without, grid->cells.size()));
  return grid;
}

}  // namespace

Result<HeightsImported> import_covered_heights(Raster& model, const std::string& path,
                                               const HeightsImport& how, const CoverOptions& cover,
                                               const ReaderLimits& bounds, std::vector<std::string>& said,
                                               const std::function<void(double)>& progress) {
  const CoverGrid grid = TRY(grid_in(cover, model, how, bounds, said));
  const PassingFile bare(unfinished_name(path) + "-heights");
  auto imported = TRY(import_heights(model, bare.path(), how, [&](double part) { progress(0.5 * part); }));
  const auto heights = TRY(GroundFile::open(bare.path()));
  const Raster::Shape shape = model.shape();
  const double cell_z_m = how.cell_m.value_or(shape.cell_z_m.value_or(1.0));
  const double columns_a_row = shape.cell_x_m && shape.cell_z_m ? *shape.cell_x_m / *shape.cell_z_m : 1.0;
  const CoverImport on{.width_m = shape.columns * cell_z_m * columns_a_row,
                       .depth_m = shape.rows * cell_z_m,
                       .reach_m = cover.reach_m,
                       .voxel_size_m = cover.voxel_size_m,
                       .palette = how.palette};
  const auto covered =
      import_cover(heights, grid, path, on, [&](double part) { progress(0.5 + 0.5 * part); });
  if (!covered) return fail(cover.raster + ": " + covered.error().message);
  said.push_back(fmt::format("{}: it covers the ground {:.4g} m deep, in {} stored chunks of voxels of {} m",
                             cover.raster, cover.reach_m, covered->chunks, cover.voxel_size_m));
  imported.header = covered->header;
  imported.bytes = covered->bytes;
  return imported;
}

}  // namespace scree
