#include "client/viewer/session/refusal_words.h"

#include <algorithm>
#include <array>

namespace scree {
namespace {

struct BriefRow {
  std::string_view refusal;
  std::string_view words;
};

constexpr std::array rows{
    BriefRow{"reach", "too far away"},
    BriefRow{"out_of_sight", "not in sight"},
    BriefRow{"in_region", "this is protected"},
    BriefRow{"role", "you may not"},
    BriefRow{"not_on_foot", "stand first: Q"},
    BriefRow{"requests_per_second", "too fast"},
    BriefRow{"dig_rate", "wait a moment"},
    BriefRow{"store_full", "your store is full"},
    BriefRow{"store_lacks", "you carry too little"},
    BriefRow{"store_missing", "you carry nothing"},
    BriefRow{"in_the_way", "something stands there"},
    BriefRow{"pieces_max", "too much rubble"},
    BriefRow{"pieces_share", "too much rubble"},
    BriefRow{"requests_waiting", "the server is busy"},
    BriefRow{"commands_waiting", "the server is busy"},
    BriefRow{"falls_waiting", "the server is busy"},
    BriefRow{"memory_max", "the world is full"},
    BriefRow{"blast_speed", "too strong a blast"},
    BriefRow{"host", "not allowed here"},
};

bool names_an_option(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
  });
}

}  // namespace

std::string_view in_brief(std::string_view refusal) {
  if (refusal.starts_with("game:")) refusal = "host";
  const auto* const found = std::ranges::find(rows, refusal, &BriefRow::refusal);
  return found == rows.end() ? "not possible here" : found->words;
}

std::string without_options(std::string words) {
  for (size_t at = words.find(" ("); at != std::string::npos; at = words.find(" (", at)) {
    const size_t end = words.find(')', at);
    if (end == std::string::npos) break;
    if (names_an_option(std::string_view(words).substr(at + 2, end - at - 2)))
      words.erase(at, end + 1 - at);
    else
      at = end;
  }
  return words;
}

}  // namespace scree
