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

std::string pack_signs(const std::vector<Sign>& signs) {
  const std::vector<uint8_t> bytes = encode(ServerMessage(SignsMessage{signs}));
  return {bytes.begin() + length_prefix_bytes, bytes.end()};
}

std::vector<Sign> unpack_signs(const std::string& packed, FieldChecker& check) {
  ServerMessage message = check.value_or_refuse(decode_server(as_span(packed)));
  if (auto* const signs = std::get_if<SignsMessage>(&message)) return std::move(signs->signs);
  check.refuse("a message has no signs, as it should");
  return {};
}

}  // namespace scree
