#include "server/field/vdb_field.h"

#include <algorithm>
#include <openvdb/tree/Tree.h>
#include <type_traits>

#include "shared/base/check.h"

namespace scree {

namespace {

using CodeTree = openvdb::tree::Tree4<Code, 5, 4, 3>::Type;
using Leaf = CodeTree::LeafNodeType;
static_assert(Leaf::DIM == brick_size && Leaf::SIZE == brick_voxels);
static_assert(sizeof(Brick) == brick_voxels && alignof(Brick) == 1 && std::is_standard_layout_v<Brick>);

/// Tree level of a tile as large as a brick, and as a region of 16 bricks a side.
constexpr openvdb::Index brick_tile_level = 1;
constexpr openvdb::Index region_tile_level = 2;

using Region = CodeTree::RootNodeType::ChildNodeType::ChildNodeType;
static_assert(Region::DIM == 16 * brick_size);

openvdb::Coord origin(BrickCoord coord) {
  const VoxelCoord first = first_voxel(coord);
  return {first.x, first.y, first.z};
}

}  // namespace

struct VdbField::Tree {
  CodeTree tree{code_air};
  mutable openvdb::tree::ValueAccessor<CodeTree> accessor{tree};

  /// A tile that replaces a leaf deletes it, but the accessor still points to it: so the accessor is cleared.
  void set_tile(const openvdb::Coord& at, Code code, bool active) {
    accessor.addTile(brick_tile_level, at, code, active);
    accessor.clear();
  }
};

VdbField::VdbField(const TerrainSource& source) : Field(source), tree_(std::make_unique<Tree>()) {}
VdbField::~VdbField() = default;

uint64_t VdbField::memory_bytes() const {
  return tree_->tree.memUsage();
}

const Brick* VdbField::find_edited(BrickCoord coord) const {
  const openvdb::Coord at = origin(coord);
  // A leaf's buffer is 512 contiguous codes in a brick's order (asserted above): the leaf is the brick.
  if (const Leaf* leaf = tree_->accessor.probeConstLeaf(at))
    return reinterpret_cast<const Brick*>(leaf->buffer().data());
  Code code = code_air;
  if (!tree_->accessor.probeValue(at, code)) return nullptr;
  CHECK_DEBUG(code == code_air || code == code_solid);
  return code == code_air ? &air_brick() : &solid_brick();
}

void VdbField::store_edited(BrickCoord coord, const Brick& brick) {
  const openvdb::Coord at = origin(coord);
  if (uniform_equivalent(brick) != nullptr) {
    tree_->set_tile(at, brick.codes.front(), true);
    CHECK_DEBUG(find_edited(coord) == uniform_equivalent(brick));
    return;
  }
  Leaf* leaf = tree_->accessor.touchLeaf(at);
  std::ranges::copy(brick.codes, leaf->buffer().data());
  leaf->setValuesOn();
  CHECK_DEBUG(find_edited(coord) != nullptr && *find_edited(coord) == brick);
}

void VdbField::erase_edited(BrickCoord coord) {
  tree_->set_tile(origin(coord), code_air, false);
  CHECK_DEBUG(find_edited(coord) == nullptr);
}

void VdbField::chunk_left(ChunkCoord chunk) {
  const openvdb::Coord at = origin(brick_in_chunk(chunk, 0));
  const Region* const region = tree_->accessor.probeConstNode<Region>(at);
  if (region == nullptr || !region->getChildMask().isOff() || !region->getValueMask().isOff()) return;
  tree_->tree.root().addTile(region_tile_level, at, code_air, false);
  tree_->accessor.clear();
}

}  // namespace scree
