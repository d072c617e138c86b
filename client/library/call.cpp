#include "client/library/call.h"

#include <algorithm>
#include <array>

#include "proto/protocol_version.h"
#include "shared/base/text.h"

namespace scree {
namespace {

/// A place that stays, for who reads the words too late: they are others then, and nothing worse.
std::array<char, 512>& last_words() {
  thread_local std::array<char, 512> words{};
  return words;
}

}  // namespace

scree_result fail(scree_result code, std::string words) {
  const std::string shown = showable(words, last_words().size() - 1);
  std::copy_n(shown.c_str(), shown.size() + 1, last_words().begin());
  return code;
}

}  // namespace scree

extern "C" {

const char* scree_error() {
  return scree::last_words().data();
}

const char* scree_version() {
  return SCREE_VERSION;
}

uint32_t scree_protocol() {
  return scree::protocol_version;
}
}
