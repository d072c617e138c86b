#include "proto/height_wire.h"

#include <algorithm>

#include "proto/limits.h"

namespace scree {

namespace {

std::string pack_keys(const std::vector<TileKey>& keys) {
  std::vector<ChunkCoord> coords;
  coords.reserve(keys.size());
  for (const TileKey key : keys) coords.push_back({key.x, key.level, key.z});
  return pack_chunks(coords);
}

std::vector<TileKey> read_keys(const std::string& packed, size_t count_max, const char* what,
                               FieldChecker& check) {
  std::vector<TileKey> keys;
  for (const ChunkCoord coord : check.chunks(packed, count_max, what))
    keys.push_back({coord.y, coord.x, coord.z});
  return keys;
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
  return ground;
}

void write(wire::TileRequest& to, const TileRequest& from) {
  to.set_wanted(pack_keys(from.wanted));
  to.set_held(pack_keys(from.held));
}

TileRequest read_tile_request(const wire::TileRequest& from, FieldChecker& check) {
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
