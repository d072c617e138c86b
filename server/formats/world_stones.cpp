#include "server/formats/world_stones.h"

#include <world.pb.h>

#include "proto/limits.h"
#include "proto/operation_codec.h"
#include "proto/wire_values.h"
#include "server/formats/recording_values.h"

namespace scree {

std::vector<uint8_t> encode(const SettledStone& stone) {
  kept::Stone to;
  to.set_id(stone.id);
  to.set_volume(to_string(encode_volume(*stone.volume)));
  to.set_x(stone.pose.x);
  to.set_y(stone.pose.y);
  to.set_z(stone.pose.z);
  to.set_rotation(stone.pose.rotation);
  to.set_lies(stone.lies);
  return bytes_of(to);
}

Result<SettledStone> decode_stone(std::span<const uint8_t> bytes) {
  const auto from = TRY(parsed<kept::Stone>(bytes, "stone of the world"));
  FieldChecker check("stone of the world");
  SettledStone stone{from.id(), nullptr, {from.x(), from.y(), from.z(), from.rotation()}, from.lies()};
  stone.volume = std::make_shared<const Volume>(check.value_or_refuse(decode_volume(as_span(from.volume()))));
  for (const int32_t position : {stone.pose.x, stone.pose.y, stone.pose.z})
    if (position < -limits::pose_coordinate_max || position > limits::pose_coordinate_max)
      check.refuse("its position is 2^30 steps or more from the origin");
  if (stone.lies == 0) check.refuse("nothing of it is rock");
  if (check.failed()) return tl::unexpected(check.error());
  return stone;
}

}  // namespace scree
