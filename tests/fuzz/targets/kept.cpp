// What files keep of worlds and grounds: the first byte chooses a decoder, the rest is for it.
//
// Holds: what is decoded can be encoded, and decodes to the same bytes. The value of a restored world
// restores to itself, and the world goes on with a ledger that balances; what can be salvaged of a value can
// be restored. A file that is no ground is refused; one that is has the tiles that its header names.
#include <array>
#include <vector>

#include "ground/ground_file.h"
#include "proto/height_codec.h"
#include "server/formats/world_codec.h"
#include "server/world/world.h"
#include "shared/base/check.h"
#include "tests/fuzz/support/fuzz_input.h"
#include "tests/fuzz/support/scratch_file.h"
#include "tests/fuzz/support/target.h"

namespace scree {
namespace {

using Bytes = std::span<const uint8_t>;

/// The sizes of a value that is restored; larger ones are only decoded.
constexpr size_t pieces_max = 8, bricks_max = 64;
constexpr int ticks = 3;
constexpr int32_t samples_max = 300;  ///< of a ground, a side

/// What `encode` makes of what `decode` makes of it is the same the second time.
template <typename Decode>
auto round_trip(Bytes bytes, const Decode& decode) {
  auto value = decode(bytes);
  if (!value) {
    CHECK(!value.error().message.empty());
    return value;
  }
  const std::vector<uint8_t> encoded = encode(*value);
  const auto again = decode(Bytes(encoded));
  CHECK(again.has_value());
  CHECK(encode(*again) == encoded);
  return value;
}

void world(Bytes bytes) {
  const auto value = round_trip(bytes, decode_world);
  if (!value || value->moment.pieces.size() > pieces_max || value->bricks.size() > bricks_max) return;
  const auto restored = World::restore(*value);
  if (restored) {
    const WorldSnapshot snapshot = (*restored)->snapshot();  // all settings, where the value may lack some
    const auto again = World::restore(snapshot);
    CHECK(again && encode((*again)->snapshot()) == encode(snapshot));
    for (int i = 0; i < ticks; ++i) CHECK((*restored)->step({})->ledger.error() == 0);
  }
  const auto salvaged = World::salvage(*value);
  if (salvaged) CHECK(World::restore((*salvaged)->snapshot()).has_value());
}

void header(Bytes bytes) {
  const auto value = decode_world_header(bytes);
  if (value && value->format == world_format) round_trip(bytes, decode_world_header);
}
void chunk(Bytes bytes) {
  round_trip(bytes, decode_world_chunk);
}
void piece(Bytes bytes) {
  round_trip(bytes, decode_piece_record);
}
void moment(Bytes bytes) {
  round_trip(bytes, decode_world_moment);
}

void ground(Bytes bytes) {
  const ScratchFile file("kept");
  file.write(bytes);
  const auto header = bytes.size() < header_bytes ? fail("short") : decode_header(bytes.first(header_bytes));
  if (header && std::max(header->ground.layout.columns, header->ground.layout.rows) > samples_max) return;
  const auto opened = GroundFile::open(file.path());
  if (!opened) return;
  CHECK(header.has_value() && (*opened)->name() == name_of(*header));
  CHECK((*opened)->tile((*opened)->layout().top()) != nullptr);
}

void tile(Bytes bytes) {
  const HeightLayout layout{200, 150, 2.0F, -1000, 1000, {}};
  for (const TileKey key : {TileKey{0, 1, 1}, layout.top()}) {
    const auto value = unpack_tile(bytes, key, layout);
    if (!value) continue;
    const std::vector<uint8_t> packed = pack_tile(value->children, value->tile);
    const auto again = unpack_tile(packed, key, layout);
    CHECK(again && again->children == value->children && again->tile.heights == value->tile.heights);
  }
}

/// The place is the first byte of an input: new ones come last.
constexpr std::array<void (*)(Bytes), 7> decoders = {world, header, chunk, piece, moment, ground, tile};

}  // namespace
}  // namespace scree

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  scree::FuzzInput input(data, size);
  const uint32_t decoder = input.below(scree::decoders.size());
  scree::decoders[decoder](input.rest());
  return 0;
}
