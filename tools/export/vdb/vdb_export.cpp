#include "tools/export/vdb/vdb_export.h"

#include <filesystem>
#include <openvdb/io/File.h>
#include <openvdb/io/Stream.h>
#include <ostream>
#include <streambuf>
#include <string>

#include "ground/whole_file.h"
#include "proto/palette_codec.h"
#include "shared/field/heights.h"
#include "tools/import/vdb/vdb_grids.h"
#include "tools/import/vdb/vdb_names.h"

namespace scree {

namespace {

using openvdb::Coord;
using openvdb::FloatGrid;
using openvdb::Int32Grid;

/// Tree level of a tile as large as a brick.
constexpr openvdb::Index brick_tile_level = 1;

struct Grids {
  FloatGrid::Ptr surface;
  Int32Grid::Ptr material;
};

template <typename T, typename Grid>
void tell(Grid& grid, const char* name, const T& value) {
  grid.insertMeta(name, openvdb::TypedMetadata<T>(value));
}

void tell_ground(FloatGrid& grid, const TerrainSource& source, const ChunkBox& box) {
  tell(grid, vdb_names::voxel_size_m, source.voxel_size_m);
  tell(grid, vdb_names::chunks_lo, openvdb::Vec3i(box.lo.x, box.lo.y, box.lo.z));
  tell(grid, vdb_names::chunks_hi, openvdb::Vec3i(box.hi.x, box.hi.y, box.hi.z));
  const MaterialHeights layers = layers_of(source);
  tell(grid, vdb_names::soil_below_m, layers.soil_below_m);
  tell(grid, vdb_names::ice_above_m, layers.ice_above_m);
  if (source.heights == nullptr) return;
  const HeightLayout& heights = source.heights->layout();
  if (heights.lowest == heights.highest)
    tell(grid, vdb_names::level_m, static_cast<double>(heights.lowest) / height_steps_per_m);
}

void tell_palette(Int32Grid& grid, const Palette& palette) {
  std::string names, digits;
  for (const std::string_view name : palette.names()) names += std::string(name) + "\n";
  constexpr std::string_view hex = "0123456789abcdef";
  for (const uint8_t byte : encode_palette(palette)) {
    digits += hex[byte >> 4];
    digits += hex[byte & 15];
  }
  tell(grid, vdb_names::material_names, names);
  tell(grid, vdb_names::palette, digits);
}

Grids empty_grids(const TerrainSource& source, const Palette& palette, const ChunkBox& box) {
  openvdb::initialize();
  const auto voxel_m = static_cast<double>(source.voxel_size_m);
  Grids grids{FloatGrid::create(band_voxels * source.voxel_size_m), Int32Grid::create(0)};
  grids.surface->setName(vdb_names::surface);
  grids.surface->setGridClass(openvdb::GRID_LEVEL_SET);
  grids.surface->setCreator("Scree");
  grids.material->setName(vdb_names::material);
  grids.material->setCreator("Scree");
  for (openvdb::GridBase::Ptr grid :
       {openvdb::GridBase::Ptr(grids.surface), openvdb::GridBase::Ptr(grids.material)})
    grid->setTransform(openvdb::math::Transform::createLinearTransform(voxel_m));
  tell_ground(*grids.surface, source, box);
  tell_palette(*grids.material, palette);
  return grids;
}

void add_brick(const Brick& brick, const Coord& at, float voxel_m, FloatGrid& grid) {
  const Brick* uniform = uniform_equivalent(brick);
  if (uniform == &air_brick()) return;
  if (uniform == &solid_brick()) {
    grid.tree().addTile(brick_tile_level, at, -band_voxels * voxel_m, false);
    return;
  }
  auto* leaf = grid.tree().touchLeaf(at);
  for (openvdb::Index i = 0; i < brick_voxels; ++i) {
    const Code code = brick.codes[i];
    leaf->setValueOnly(i, decode(code) * voxel_m);
    leaf->setActiveState(i, code > code_solid && code < code_air);
  }
}

/// Active where they are said.
void add_materials(const BrickMaterials& said, const Coord& at, Int32Grid& grid) {
  if (said.is_ground()) return;
  if (said.is_uniform()) {
    grid.tree().addTile(brick_tile_level, at, static_cast<int32_t>(row_number(material_of(said.uniform()))),
                        true);
    return;
  }
  auto* leaf = grid.tree().touchLeaf(at);
  for (openvdb::Index i = 0; i < brick_voxels; ++i)
    if (const VoxelMaterial one = said.at(static_cast<int>(i)); one != ground_own)
      leaf->setValueOn(i, static_cast<int32_t>(row_number(material_of(one))));
}

void add_chunk(Field& field, ChunkCoord chunk, Grids& grids) {
  for (int i = 0; i < static_cast<int>(chunk_brick_count); ++i) {
    const BrickCoord coord = brick_in_chunk(chunk, i);
    const VoxelCoord first = first_voxel(coord);
    const Coord at(first.x, first.y, first.z);
    add_brick(field.brick(coord), at, field.source().voxel_size_m, *grids.surface);
    add_materials(said_materials(field, coord), at, *grids.material);
  }
}

/// Makes the faces where the box cuts the rock a part of the narrow band, so that a program that reads active
/// voxels alone sees a closed surface. No value in the box changes.
void close_walls(const VoxelBox& box, FloatGrid& grid) {
  auto voxels = grid.getAccessor();
  const float air_m = grid.background();
  const std::array<int, 3> lo{box.lo.x, box.lo.y, box.lo.z}, hi{box.hi.x, box.hi.y, box.hi.z};
  for (size_t axis = 0; axis < 3; ++axis) {
    const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const auto& [inside, outside] :
         {std::pair(lo[axis], lo[axis] - 1), std::pair(hi[axis] - 1, hi[axis])}) {
      std::array<int, 3> at{};
      for (at[u] = lo[u]; at[u] < hi[u]; ++at[u])
        for (at[v] = lo[v]; at[v] < hi[v]; ++at[v]) {
          at[axis] = inside;
          const Coord rock(at[0], at[1], at[2]);
          if (!(voxels.getValue(rock) < 0.0F)) continue;
          voxels.setActiveState(rock, true);
          at[axis] = outside;
          voxels.setValueOn(Coord(at[0], at[1], at[2]), air_m);
        }
    }
  }
}

/// Counts what is written to it, and keeps nothing.
class CountingBuffer final : public std::streambuf {
 public:
  uint64_t bytes() const { return bytes_; }

 protected:
  std::streamsize xsputn(const char* /*text*/, std::streamsize count) override {
    bytes_ += static_cast<uint64_t>(count);
    return count;
  }
  int_type overflow(int_type byte) override {
    ++bytes_;
    return traits_type::not_eof(byte);
  }
  pos_type seekoff(off_type off, std::ios_base::seekdir from, std::ios_base::openmode /*which*/) override {
    return off == 0 && from == std::ios_base::cur ? pos_type(static_cast<off_type>(bytes_))
                                                  : pos_type(off_type(-1));
  }

 private:
  uint64_t bytes_ = 0;
};

/// The bytes of a file with these grids. They are written as to a stream, which takes the same number of
/// bytes.
uint64_t bytes_of(const openvdb::GridCPtrVec& grids) {
  CountingBuffer buffer;
  std::ostream stream(&buffer);
  openvdb::io::Stream(stream).write(grids);
  return buffer.bytes();
}

/// OpenVDB does not notice that a disk is full, and reads gigabytes out of a file that was cut short: its
/// size tells.
Result<uint64_t> write(const Grids& grids, const std::string& path) {
  return write_whole(path, [&](const std::string& unfinished) -> Result<void> {
    try {
      const openvdb::GridCPtrVec both{grids.surface, grids.material};
      {
        openvdb::io::File file(unfinished);
        file.write(both);
        file.close();
      }
      if (std::filesystem::file_size(unfinished) == bytes_of(both)) return {};
      return fail("what was written is not whole: is the disk full?");
    } catch (const std::exception& failure) {
      return fail(std::string("it cannot be written whole (") + failure.what() + ")");
    }
  });
}

}  // namespace

Result<VdbExported> export_vdb(Field& field, const Palette& palette, const ChunkBox& box,
                               const std::string& path, const std::function<void(double)>& progress) {
  Grids grids = empty_grids(field.source(), palette, box);
  size_t done = 0;
  for_each_chunk(box.voxels(), [&](ChunkCoord chunk) {
    add_chunk(field, chunk, grids);
    progress(static_cast<double>(++done) / static_cast<double>(box.count()));
  });
  close_walls(box.voxels(), *grids.surface);
  grids.surface->pruneGrid();
  grids.material->pruneGrid();
  const uint64_t active_voxels = grids.surface->activeVoxelCount();
  const auto bytes = TRY(write(grids, path));
  return VdbExported{active_voxels, bytes};
}

}  // namespace scree
