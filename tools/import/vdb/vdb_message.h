// What the process that reads an OpenVDB file sends: the grid that becomes rock, as its own tiles and leaves.
// Internal to import/vdb.
#pragma once

#include <array>
#include <cstdint>

#include "tools/import/process/reader_channel.h"
#include "tools/import/vdb/vdb_grids.h"

namespace scree {

/// First come this, the grid's name and words on other grids; then the grid, and the materials' grid.
struct VdbHead {
  std::array<double, 16> to_world{};            ///< the transform's matrix, by rows
  std::array<double, 16> materials_to_world{};  ///< likewise
  float least = 0.0F;                           ///< of the grid's values
  float greatest = 0.0F;
  uint8_t is_level_set = 0;
  uint8_t has_materials =
      0;  ///< then their names (a list of bytes) and their palette's bytes come before them
  /// Metadata of exports; each bit of `told` says whether there is one, in this order.
  uint8_t told = 0;
  float voxel_size_m = 0.0F;
  float soil_below_m = 0.0F;
  float ice_above_m = 0.0F;
  double level_m = 0.0;
  std::array<int32_t, 3> chunks_lo{};
  std::array<int32_t, 3> chunks_hi{};
};

enum class VdbTold : uint8_t { voxel_size = 1, soil_below = 2, ice_above = 4, level = 8, chunks = 16 };

inline bool has(const VdbHead& head, VdbTold what) {
  return (head.told & static_cast<uint8_t>(what)) != 0;
}

/// Equal values in a cube of 8, 128 or 4096 voxels a side: level 1, 2 or 3. `is_active` is OpenVDB's state:
/// where a grid of materials is inactive, it names no material.
template <typename T>
struct VdbTile {
  std::array<int32_t, 3> at;
  int32_t level;
  int32_t is_active;
  T value;
};

/// Voxels in a cube of 8 a side, as OpenVDB orders them.
template <typename T>
struct VdbLeaf {
  std::array<int32_t, 3> at;
  std::array<uint8_t, 512> is_active;
  std::array<T, 512> values;
};

template <typename Grid>
Result<void> send_grid(ReaderChannel& channel, const Grid& grid) {
  using T = typename Grid::ValueType;
  const auto& tree = grid.tree();
  TRY(channel.put(tree.background()));
  std::vector<VdbTile<T>> tiles;
  auto tile = tree.cbeginValueAll();
  tile.setMaxDepth(Grid::TreeType::ValueAllCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    if (*tile == tree.background() && !tile.isValueOn()) continue;
    openvdb::CoordBBox box;
    tile.getBoundingBox(box);
    tiles.push_back({{box.min().x(), box.min().y(), box.min().z()},
                     static_cast<int32_t>(tile.getLevel()),
                     tile.isValueOn() ? 1 : 0,
                     *tile});
  }
  TRY(channel.put_list(tiles));
  TRY(channel.put(static_cast<uint64_t>(tree.leafCount())));
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
    const openvdb::Coord at = leaf->origin();
    VdbLeaf<T> sent{{at.x(), at.y(), at.z()}, {}, {}};
    for (openvdb::Index i = 0; i < sent.values.size(); ++i) {
      sent.values[i] = leaf->getValue(i);
      sent.is_active[i] = leaf->isValueOn(i) ? 1 : 0;
    }
    TRY(channel.put(sent));
  }
  return {};
}

/// `is_right(value)`: whether a value is one that there may be.
template <typename Grid, typename Check>
Result<typename Grid::Ptr> receive_grid(ReaderChannel& channel, uint64_t leaves_max, Check&& is_right) {
  using T = typename Grid::ValueType;
  constexpr int32_t far = 1 << 30;
  const auto is_place = [](const std::array<int32_t, 3>& at, int32_t side) {
    for (const int32_t axis : at)
      if (axis < -far || axis > far || (axis & (side - 1)) != 0) return false;
    return true;
  };
  const auto background = TRY(channel.get<T>());
  if (!is_right(background)) return fail("the grid's background is not a number");
  auto grid = Grid::create(background);
  auto tiles = TRY(channel.get_list<VdbTile<T>>(leaves_max));
  std::ranges::stable_sort(tiles, [](const auto& one, const auto& other) { return one.level > other.level; });
  for (const VdbTile<T>& tile : tiles) {
    constexpr std::array<int32_t, 4> sides = {1, 8, 128, 4096};
    if (tile.level < 1 || tile.level > 3 || !is_place(tile.at, sides[static_cast<size_t>(tile.level)]) ||
        !is_right(tile.value))
      return fail("the grid has a tile that is none");
    grid->tree().addTile(static_cast<openvdb::Index>(tile.level), {tile.at[0], tile.at[1], tile.at[2]},
                         tile.value, tile.is_active != 0);
  }
  const auto leaves = TRY(channel.get<uint64_t>());
  if (leaves > leaves_max) return fail("the grid has more bricks than there can be");
  for (uint64_t i = 0; i < leaves; ++i) {
    const auto leaf = TRY(channel.get<VdbLeaf<T>>());
    if (!is_place(leaf.at, 8) || !std::ranges::all_of(leaf.values, is_right))
      return fail("the grid has a brick that is none");
    auto* const made = grid->tree().touchLeaf({leaf.at[0], leaf.at[1], leaf.at[2]});
    for (openvdb::Index k = 0; k < leaf.values.size(); ++k) {
      made->setValueOnly(k, leaf.values[k]);
      made->setActiveState(k, leaf.is_active[k] != 0);
    }
  }
  return grid;
}

}  // namespace scree
