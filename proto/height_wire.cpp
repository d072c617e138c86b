#include "proto/height_wire.h"

#include <algorithm>
#include <fmt/format.h>

#include "proto/byte_stream.h"
#include "proto/limits.h"

namespace scree {

namespace {

/// A key as a coordinate: its level in the low bits of y, and whether it is one of bricks.
constexpr int level_bits = 5;
constexpr int brick_bit = 1 << level_bits;

ChunkCoord coord_of(TileKey key) {
  const int kind = key.kind == TileKind::bricks ? brick_bit : 0;
  return {key.x, key.y * 2 * brick_bit + kind + key.level, key.z};
}

TileKey key_of(ChunkCoord coord) {
  return {coord.y & (brick_bit - 1), coord.x, coord.z, coord.y >> (level_bits + 1),
          (coord.y & brick_bit) != 0 ? TileKind::bricks : TileKind::heights};
}

std::string pack_keys(const std::vector<TileKey>& keys) {
  std::vector<ChunkCoord> coords;
  coords.reserve(keys.size());
  for (const TileKey key : keys) coords.push_back(coord_of(key));
  return pack_chunks(coords);
}

std::vector<TileKey> read_keys(const std::string& packed, size_t count_max, const char* what,
                               FieldChecker& check) {
  std::vector<TileKey> keys;
  ByteReader reader(as_span(packed), what);
  for (ChunkCoord before; !reader.at_end();) {
    if (keys.size() == count_max) {
      reader.refuse(fmt::format("more than {} tiles", count_max));
      break;
    }
    before = read_coord(reader, before, limits::tile_coordinate_max, "coordinate of a tile");
    keys.push_back(key_of(before));
  }
  if (reader.failed()) check.refuse(reader.error().message);
  return keys;
}

void write(wire::BrickGround& to, const BrickGround& from) {
  to.set_box(pack_chunks({from.layout.lo, from.layout.hi}));
  to.set_voxel_size_m(from.layout.voxel_size_m);
  to.set_root(std::string(from.root.begin(), from.root.end()));
}

BrickGround read_bricks(const wire::BrickGround& from, FieldChecker& check) {
  BrickGround ground;
  const std::vector<ChunkCoord> box = check.chunks(from.box(), 2, "box of the stored bricks");
  ground.layout.voxel_size_m = check.finite(from.voxel_size_m(), "voxel_size_m of the stored bricks");
  if (box.size() != 2 || from.root().size() != ground.root.size()) {
    check.refuse("the box of the stored bricks is not of two corners, or their hash not of 32 bytes");
    return ground;
  }
  ground.layout.lo = box[0];
  ground.layout.hi = box[1];
  std::ranges::copy(as_span(from.root()), ground.root.begin());
  if (check.failed()) return ground;
  if (Result<void> valid = validate(ground.layout); !valid) check.refuse(valid.error().message);
  return ground;
}

}  // namespace

void write(wire::HeightGround& to, const HeightGround& from) {
  const HeightLayout& layout = from.layout;
  to.set_columns(static_cast<uint32_t>(layout.columns));
  to.set_rows(static_cast<uint32_t>(layout.rows));
  to.set_cell_m(layout.cell_m);
  to.set_lowest(layout.lowest);
  to.set_highest(layout.highest);
  to.set_soil_below_m(layout.layers.soil_below_m);
  to.set_ice_above_m(layout.layers.ice_above_m);
  to.set_top(std::string(from.top.begin(), from.top.end()));
  if (from.bricks) write(*to.mutable_bricks(), *from.bricks);
}

HeightGround read_heights(const wire::HeightGround& from, FieldChecker& check) {
  HeightGround ground;
  HeightLayout& layout = ground.layout;
  layout.columns =
      static_cast<int32_t>(check.within(from.columns(), 2, limits::height_samples_max, "columns"));
  layout.rows = static_cast<int32_t>(check.within(from.rows(), 2, limits::height_samples_max, "rows"));
  layout.cell_m = check.finite(from.cell_m(), "cell_m");
  layout.lowest = from.lowest();
  layout.highest = from.highest();
  layout.layers.soil_below_m = check.finite(from.soil_below_m(), "soil_below_m");
  layout.layers.ice_above_m = check.finite(from.ice_above_m(), "ice_above_m");
  if (from.top().size() != ground.top.size()) {
    check.refuse("the hash of the coarsest tile is not of 32 bytes");
    return ground;
  }
  std::ranges::copy(as_span(from.top()), ground.top.begin());
  if (check.failed()) return ground;
  if (Result<void> valid = validate(layout); !valid) check.refuse(valid.error().message);
  if (from.has_bricks()) ground.bricks = read_bricks(from.bricks(), check);
  return ground;
}

void write(wire::GroundRows& to, const GroundRows& from) {
  to.set_bulk(static_cast<uint32_t>(from.bulk));
  to.set_soil(static_cast<uint32_t>(from.soil));
  to.set_cap(static_cast<uint32_t>(from.cap));
  to.set_soil_depth_m(from.soil_depth_m);
  to.set_cap_depth_m(from.cap_depth_m);
}

GroundRows read_rows(const wire::GroundRows& from, FieldChecker& check) {
  const auto row = [&](uint32_t number, const char* what) {
    return static_cast<Material>(check.within(number, 0, materials_max - 1, what));
  };
  const auto depth = [&](float depth_m, const char* what) {
    if (check.not_negative(depth_m, what) > limits::layer_depth_max_m)
      check.refuse(fmt::format("{} is {} m, over {} m", what, depth_m, limits::layer_depth_max_m));
    return depth_m;
  };
  return {row(from.bulk(), "the ground's bulk"), row(from.soil(), "the ground's soil"),
          row(from.cap(), "the ground's cap"), depth(from.soil_depth_m(), "depth of the ground's soil"),
          depth(from.cap_depth_m(), "depth of the ground's cap")};
}

void write(wire::RubbleRows& to, const RubbleRows& from) {
  const RubbleRows none;
  size_t rows = from.rubble.size();
  while (rows > 0 && from.rubble[rows - 1] == none.rubble[rows - 1] && from.fill[rows - 1] == fill_solid)
    --rows;
  for (size_t i = 0; i < rows; ++i) {
    to.mutable_rubble()->push_back(static_cast<char>(from.rubble[i]));
    to.mutable_stones()->push_back(static_cast<char>(from.stones[i]));
    to.mutable_fill()->push_back(static_cast<char>(from.fill[i]));
  }
}

RubbleRows read_rubble(const wire::RubbleRows& from, FieldChecker& check) {
  RubbleRows rows;
  const size_t count = from.rubble().size();
  if (count > materials_max || from.stones().size() != count || from.fill().size() != count) {
    check.refuse("the lists of rubble are not of one length, of 255 at most");
    return rows;
  }
  for (size_t i = 0; i < count; ++i) {
    rows.rubble[i] = static_cast<Material>(static_cast<uint8_t>(from.rubble()[i]));
    rows.stones[i] = static_cast<Material>(static_cast<uint8_t>(from.stones()[i]));
    rows.fill[i] = static_cast<uint8_t>(from.fill()[i]);
    rows.any = rows.any || rows.fill[i] != fill_solid;
  }
  for (size_t i = 0; i < count; ++i) {
    const size_t stones = row_number(rows.stones[i]), rubble = row_number(rows.rubble[i]);
    const bool is_rubble = rows.fill[i] != fill_solid;
    const bool agrees =
        is_rubble ? rows.fill[i] >= rubble_fill_min && rows.fill[i] < fill_solid && stones < i &&
                        rubble == i && rows.fill[stones] == fill_solid
                  : stones == i && (rubble == i || (rubble < count && rows.fill[rubble] != fill_solid));
    if (!agrees) check.refuse(fmt::format("material {} is neither rubble nor what becomes rubble", i));
  }
  return rows;
}

void write(wire::TileRequest& to, const AskTilesMessage& from) {
  to.set_wanted(pack_keys(from.wanted));
  to.set_held(pack_keys(from.held));
}

AskTilesMessage read_tile_request(const wire::TileRequest& from, FieldChecker& check) {
  return {read_keys(from.wanted(), limits::tiles_wanted_max, "tiles wanted", check),
          read_keys(from.held(), limits::tiles_held_max, "tiles held", check)};
}

void write(wire::Tile& to, const TileMessage& from) {
  to.set_key(pack_keys({from.key}));
  to.set_tile(to_string(from.bytes));
}

TileMessage read_tile(const wire::Tile& from, FieldChecker& check) {
  TileMessage tile;
  const std::vector<TileKey> keys = read_keys(from.key(), 1, "key of a tile", check);
  if (keys.size() == 1)
    tile.key = keys.front();
  else
    check.refuse("a tile without a key");
  const std::string bytes = check.bytes(from.tile(), limits::tile_bytes_max, "tile");
  tile.bytes.assign(bytes.begin(), bytes.end());
  return tile;
}

}  // namespace scree
