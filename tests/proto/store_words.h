// Stores and the requests about them in words, as message_words.h.
#pragma once

#include "tests/proto/message_words.h"

namespace scree {

inline std::string words(const MaterialMasses& masses) {
  std::string all;
  for (const MaterialMass& one : masses)
    all += fmt::format("{}{} of material {}", all.empty() ? "" : ", ", one.mass, row_number(one.material));
  return all.empty() ? "nothing" : all;
}

inline Lines words(const std::vector<StoreContent>& stores) {
  Lines lines;
  for (const StoreContent& one : stores)
    lines.push_back(fmt::format("{}: {}", text_of(one.store), words(one.masses)));
  return lines;
}

inline Lines describe(const DigMessage& m) {
  return {fmt::format("dig: request {}, {}, into {}", m.request,
                      m.piece != 0 ? fmt::format("piece {}", m.piece) : "terrain", text_of(m.store)),
          words(m.shape)};
}
inline Lines describe(const PlaceMessage& m) {
  return {fmt::format("place: request {}, material {}{}, out of {}", m.request, row_number(m.material),
                      m.solid ? ", solid" : "", text_of(m.store)),
          words(m.shape)};
}
inline Lines describe(const TransferMessage& m) {
  const std::string what =
      m.material ? fmt::format("{} of material {}", m.mass, row_number(*m.material)) : "all";
  return {
      fmt::format("transfer: request {}, {} from {} to {}", m.request, what, text_of(m.from), text_of(m.to))};
}
inline Lines describe(const StoresMessage& m) {
  Lines lines{"stores:"};
  append(lines, words(m.stores));
  return lines;
}

}  // namespace scree
