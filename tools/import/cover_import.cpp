#include "tools/import/cover_import.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "ground/ground_writer.h"
#include "shared/field/field.h"
#include "tools/import/chunk_pyramid.h"
#include "tools/import/limits.h"

namespace scree {

namespace {

/// A difference of the sizes of two rasters that is rounding.
constexpr double same_size = 0.01;

/// Number of a class, to either side of 0: beyond, doubles leave whole numbers out.
constexpr double class_max = 9007199254740991.0;

class Coverer {
 public:
  Coverer(const TerrainSource& source, const CoverGrid& cover, const CoverImport& how)
      : cover_(cover), how_(how), voxel_m_(static_cast<double>(how.voxel_size_m)), ground_(source) {
    ground_.bound_generated(size_t{16} << 20U);
  }

  Result<ChunkPyramid::Level> finest(const std::function<void(double)>& progress) {
    const double chunk_m = voxel_m_ * chunk_size;
    const auto reach = [&](double side_m) { return static_cast<int>(std::ceil(0.5 * side_m / chunk_m)); };
    const int wide = reach(how_.width_m), deep = reach(how_.depth_m);
    if (4ULL * static_cast<uint64_t>(wide) * static_cast<uint64_t>(deep) > limits::import_chunks_max)
      return too_many();
    for (int x = -wide; x < wide; ++x) {
      for (int z = -deep; z < deep; ++z) TRY(add_column(x, z));
      progress(0.8 * (x + wide + 1) / (2.0 * wide));
    }
    if (level_.empty()) return fail("no cell of the cover has a class that the map names (--cover-map)");
    return std::move(level_);
  }

 private:
  Result<ChunkPyramid::Level> too_many() const {
    return fail(
        fmt::format("more than {} chunks of {} voxels a side have to be stored for the cover "
                    "(limits.import_chunks_max); larger voxels (--voxel-size) make fewer, and so does a "
                    "smaller part of the model",
                    limits::import_chunks_max, chunk_size));
  }

  VoxelMaterial class_at(int x, int z) const {
    const double east = (x * voxel_m_ + 0.5 * how_.width_m) / how_.width_m,
                 south = (z * voxel_m_ + 0.5 * how_.depth_m) / how_.depth_m;
    if (east < 0.0 || south < 0.0 || east >= 1.0 || south >= 1.0) return ground_own;
    const auto column = static_cast<size_t>(east * cover_.columns),
               row = static_cast<size_t>(south * cover_.rows);
    return cover_.cells[row * static_cast<size_t>(cover_.columns) + column];
  }

  Result<void> add_column(int cx, int cz) {
    const VoxelCoord first = first_voxel(ChunkCoord{cx, 0, cz});
    const HeightPatch patch =
        heights_at(*ground_.source().heights, first.x, first.z, chunk_size, how_.voxel_size_m);
    std::array<VoxelMaterial, size_t{chunk_size} * chunk_size> classes{};
    double lowest = 1e30, highest = -1e30;
    for (int z = 0; z < chunk_size; ++z)
      for (int x = 0; x < chunk_size; ++x) {
        const auto i = static_cast<size_t>(z * chunk_size + x);
        classes[i] = class_at(first.x + x, first.z + z);
        if (classes[i] == ground_own) continue;
        lowest = std::min(lowest, patch.heights_m[i]);
        highest = std::max(highest, patch.heights_m[i]);
      }
    if (lowest > highest) return {};
    const auto chunk_at = [&](double y_m) {
      return static_cast<int>(std::floor(y_m / voxel_m_ / chunk_size));
    };
    const int top = chunk_at(highest + voxel_m_);
    for (int cy = chunk_at(lowest - static_cast<double>(how_.reach_m)); cy <= top; ++cy) {
      add_chunk({cx, cy, cz}, classes, patch);
      if (level_.size() > limits::import_chunks_max) return tl::unexpected(too_many().error());
    }
    return {};
  }

  void add_chunk(ChunkCoord at, const std::array<VoxelMaterial, size_t{chunk_size} * chunk_size>& classes,
                 const HeightPatch& patch) {
    ChunkMaterials materials;
    for (int i = 0; i < static_cast<int>(chunk_brick_count); ++i) {
      const VoxelCoord first = first_voxel(brick_in_chunk(at, i)), in = first - first_voxel(at);
      VoxelMaterials voxels{};
      for (int k = 0; k < brick_voxels; ++k) {
        const VoxelCoord voxel{k >> 6, (k >> 3) & 7, k & 7};
        const auto column = static_cast<size_t>((in.z + voxel.z) * chunk_size + in.x + voxel.x);
        const double below_m = patch.heights_m[column] - (first.y + voxel.y) * voxel_m_;
        if (below_m > -voxel_m_ && below_m < static_cast<double>(how_.reach_m))
          voxels[static_cast<size_t>(k)] = classes[column];
      }
      materials[static_cast<size_t>(i)] = BrickMaterials(voxels);
    }
    auto stored = stored_materials_of(materials);
    if (stored == nullptr) return;
    GeneratedChunk chunk = copy_of(ground_.chunk_bricks(at).generated);
    chunk.stored_materials = std::move(stored);
    level_.emplace(at, std::make_shared<const GeneratedChunk>(std::move(chunk)));
  }

  const CoverGrid& cover_;
  const CoverImport& how_;
  const double voxel_m_;
  MapField ground_;
  ChunkPyramid::Level level_;
};

}  // namespace

Result<CoverGrid> read_cover(Raster& raster, const MaterialMap& classes) {
  const Raster::Shape shape = raster.shape();
  CoverGrid cover{shape.columns,
                  shape.rows,
                  shape.columns * shape.cell_x_m.value_or(0.0),
                  shape.rows * shape.cell_z_m.value_or(0.0),
                  {}};
  const uint64_t cells = static_cast<uint64_t>(shape.columns) * static_cast<uint64_t>(shape.rows);
  if (cells > limits::cover_cells_max)
    return fail(fmt::format("it has {} cells, more than {} (limits.cover_cells_max)", cells,
                            limits::cover_cells_max));
  cover.cells.reserve(cells);
  std::map<int64_t, VoxelMaterial> known;
  std::vector<double> row(static_cast<size_t>(shape.columns));
  for (int z = 0; z < shape.rows; ++z) {
    TRY(raster.read_row(z, row));
    for (const double value : row) {
      if (std::isfinite(value) && (value != std::floor(value) || std::abs(value) > class_max))
        return fail(
            fmt::format("it holds {:.6g}: classes are whole numbers within ±{:.0f}", value, class_max));
      VoxelMaterial own = ground_own;
      if (std::isfinite(value)) {
        const auto number = static_cast<int64_t>(value);
        const auto [found, is_new] = known.try_emplace(number, ground_own);
        if (is_new)
          if (const auto to = classes.find(std::to_string(number)); to != classes.end())
            found->second = said(to->second);
        own = found->second;
      }
      cover.without += own == ground_own ? 1 : 0;
      cover.cells.push_back(own);
    }
  }
  return cover;
}

Result<void> check_same_place(Raster& cover, Raster& model, std::optional<double> model_cell_m) {
  const Raster::Shape own = cover.shape(), other = model.shape();
  if (!own.cell_x_m || !own.cell_z_m || !other.cell_x_m || !other.cell_z_m || model_cell_m) return {};
  const double width_m = own.columns * *own.cell_x_m, depth_m = own.rows * *own.cell_z_m;
  const double model_m = other.columns * *other.cell_x_m, model_depth_m = other.rows * *other.cell_z_m;
  const auto differs = [](double a, double b) { return std::abs(a - b) > same_size * b; };
  if (differs(width_m, model_m) || differs(depth_m, model_depth_m))
    return fail(
        fmt::format("the cover is {:.6g} × {:.6g} m, and the model {:.6g} × {:.6g} m: they must cover the "
                    "same place (gdalwarp -te cuts one out)",
                    width_m, depth_m, model_m, model_depth_m));
  const auto here = cover.place(), there = model.place();
  if (!here || !there || here->crs != there->crs) return {};
  if (std::abs(here->x - there->x) > same_size * model_m ||
      std::abs(here->y - there->y) > same_size * model_depth_m)
    return fail(
        fmt::format("the middle of the cover is ({:.8g}, {:.8g}), and that of the model ({:.8g}, {:.8g}): "
                    "they must cover the same place",
                    here->x, here->y, there->x, there->y));
  return {};
}

Result<CoverImported> import_cover(std::shared_ptr<const GroundFile> heights, const CoverGrid& cover,
                                   const std::string& path, const CoverImport& how,
                                   const std::function<void(double)>& progress) {
  TerrainSource source{.voxel_size_m = how.voxel_size_m, .heights = heights, .rows = how.palette->ground};
  auto level = TRY(Coverer(source, cover, how).finest(progress));
  auto writer = TRY(GroundWriter::create(path, heights->layout(), heights->header().zero_m, *how.palette));
  writer->copy_heights(*heights);
  CoverImported imported;
  imported.chunks = level.size();
  ChunkPyramid pyramid(source, std::move(level));
  writer->begin_chunks(pyramid.layout());
  pyramid.write(*writer);
  imported.header = TRY(writer->finish());
  imported.bytes = writer->bytes();
  progress(1.0);
  return imported;
}

}  // namespace scree
