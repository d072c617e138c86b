#include "server/formats/region_list.h"

#include <utility>

#include "proto/codec.h"

namespace scree {

std::string pack_regions(const std::vector<Region>& regions) {
  const std::vector<uint8_t> bytes = encode(ServerMessage(RegionsMessage{regions}));
  return {bytes.begin() + length_prefix_bytes, bytes.end()};
}

std::vector<Region> unpack_regions(const std::string& packed, FieldChecker& check) {
  ServerMessage message = check.value_or_refuse(decode_server(as_span(packed)));
  if (auto* const regions = std::get_if<RegionsMessage>(&message)) return std::move(regions->regions);
  check.refuse("a message has no regions, as it should");
  return {};
}

}  // namespace scree
