// Texts from outside that are not messages: tokens, ids, addresses, durations, names, and the files of bans
// and revoked tokens. The first byte chooses who reads the rest.
//
// Holds: each reader refuses with a reason, or takes what it can write again.
#include <algorithm>
#include <array>
#include <string>

#include "auth/access_token.h"
#include "auth/base64url.h"
#include "auth/duration_text.h"
#include "server/doors/bans.h"
#include "server/doors/door.h"
#include "shared/base/check.h"
#include "shared/base/text.h"
#include "shared/base/token.h"
#include "tests/fuzz/support/fuzz_input.h"
#include "tests/fuzz/support/scratch_file.h"
#include "tests/fuzz/support/target.h"

namespace scree {
namespace {

void shown(const std::string& text) {
  for (const size_t bytes_max : {size_t{0}, size_t{7}, text.size()}) {
    const std::string shown = showable(text, bytes_max);
    CHECK(shown.size() <= bytes_max && !fault_of_text(shown));
  }
  if (!fault_of_text(text)) CHECK(showable(text, text.size()) == text);
}

void base64(const std::string& text) {
  if (const auto bytes = from_base64url(text)) CHECK(to_base64url(*bytes) == text);
  const std::span<const uint8_t> bytes(reinterpret_cast<const uint8_t*>(text.data()), text.size());
  const auto back = from_base64url(to_base64url(bytes));
  CHECK(back && std::ranges::equal(*back, bytes));
}

void access_token(const std::string& text) {
  const auto read = read_access_token(text);
  if (!read) {
    CHECK(!read.error().message.empty());
    return;
  }
  CHECK(is_access_token(text) && read->token.id != 0);
  CHECK(!fault_of_text(read->token.name) && !fault_of_text(read->token.world));
}

void id(const std::string& text) {
  const auto number = read_id(text);
  if (number) CHECK(*read_id(id_text(*number)) == *number);
}

void duration(const std::string& text) {
  constexpr uint64_t ten_years_s = 3650ULL * 86400;
  const auto seconds = read_duration_s(text);
  if (seconds) CHECK(*seconds >= 1 && *seconds <= ten_years_s);
}

void address(const std::string& text) {
  CHECK(door_address(text).size() <= std::max<size_t>(text.size(), 64));
  const auto key = ban_key(text);
  if (!key) return;
  CHECK(ban_key(*key).value_or("") == *key);
  auto bans = Bans::open("");
  CHECK(bans.has_value() && bans->add(*key, {0, "fuzz"}, 1).has_value());
  const auto target = BanTarget::read(text);
  CHECK(target.has_value() && target->text() == *key && bans->all().contains(*key));
}

void bans_file(const std::string& text) {
  const ScratchFile file("bans");
  file.write({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
  auto bans = Bans::open(file.path());
  if (!bans) return;
  CHECK(bans->add("10.1.2.3", {77, "fuzz"}, 1).has_value());
  const auto again = Bans::open(file.path());
  CHECK(again.has_value());
  for (const auto& [key, ban] : bans->all()) {
    const auto found = again->all().find(key);
    CHECK(found != again->all().end() && found->second.until_s == ban.until_s);
    CHECK(found->second.reason == ban.reason);
  }
}

void revoked_file(const std::string& text) {
  const ScratchFile file("revoked");
  file.write({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
  const auto ids = read_revoked(file.path());
  if (ids) CHECK(std::ranges::is_sorted(*ids));
  const auto token = read_token(file.path());
  if (token) CHECK(check_token(*token).has_value() && same_token(*token, *token));
}

/// The place is the first byte of an input: new ones come last.
constexpr std::array readers = {shown, base64, access_token, id, duration, address, bans_file, revoked_file};

}  // namespace
}  // namespace scree

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  scree::FuzzInput input(data, size);
  const uint32_t reader = input.below(scree::readers.size());
  const auto rest = input.rest();
  scree::readers[reader]({rest.begin(), rest.end()});
  return 0;
}
