#include "server/net/person_names.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <unordered_set>
#include <utf8proc.h>

#include "proto/limits.h"
#include "proto/person_name.h"
#include "shared/base/check.h"
#include "shared/base/text.h"

namespace scree {

namespace {

/// Letters and symbols by Unicode's categories, whose pictures are empty: blanks of Braille, of music and of
/// Egyptian, fillers of Korean, vowels of Khmer that are not written, and the place of an object.
constexpr std::array<utf8proc_int32_t, 11> empty_pictures{0x115F, 0x1160, 0x17B4,  0x17B5,  0x2800, 0x3164,
                                                          0xFFA0, 0xFFFC, 0x1D159, 0x13441, 0x13442};

enum class Look { seen, blank, mark, formatting };

Look look_of(utf8proc_int32_t code) {
  if (std::ranges::find(empty_pictures, code) != empty_pictures.end()) return Look::blank;
  switch (utf8proc_category(code)) {
    case UTF8PROC_CATEGORY_ZS:
    case UTF8PROC_CATEGORY_ZL:
    case UTF8PROC_CATEGORY_ZP:
      return Look::blank;
    case UTF8PROC_CATEGORY_MN:
    case UTF8PROC_CATEGORY_MC:
    case UTF8PROC_CATEGORY_ME:
      return Look::mark;
    case UTF8PROC_CATEGORY_CC:
    case UTF8PROC_CATEGORY_CF:
    case UTF8PROC_CATEGORY_CS:
    case UTF8PROC_CATEGORY_CO:
    case UTF8PROC_CATEGORY_CN:
      return Look::formatting;
    default:
      return Look::seen;
  }
}

/// Calls `each` with the look and the bytes of every character. The text must be UTF-8.
template <typename Each>
void for_each_character(const std::string& text, const Each& each) {
  const auto* at = reinterpret_cast<const utf8proc_uint8_t*>(text.data());
  for (auto left = static_cast<utf8proc_ssize_t>(text.size()); left > 0;) {
    utf8proc_int32_t code = 0;
    const utf8proc_ssize_t bytes = utf8proc_iterate(at, left, &code);
    CHECK(bytes > 0);
    each(look_of(code), std::string_view(reinterpret_cast<const char*>(at), static_cast<size_t>(bytes)));
    at += bytes;
    left -= bytes;
  }
}

/// The name of somebody without one, for a session of any number.
bool is_as_nameless(const std::string& key) {
  static const std::string start = name_key(called(0, {}).substr(0, called(0, {}).size() - 1));
  return key.size() > start.size() && key.starts_with(start) &&
         key.find_first_not_of("0123456789", start.size()) == key.npos;
}

/// By the session's grant, and unlike the names of others; those whom no token names count only where none
/// names this one.
void give_name(const SessionTable& sessions, uint64_t session, SessionEntry& entry) {
  std::unordered_set<std::string_view> others;
  for (const auto& [id, other] : sessions.entries())
    if (id != session && (other.grant.vouches_name || !entry.grant.vouches_name))
      others.insert(other.name_key);
  const std::string name = visible_name(entry.grant.name);
  entry.name = name;
  entry.name_key = name_key(name);
  for (size_t number = 2; !name.empty() && others.contains(entry.name_key); ++number) {
    entry.name = numbered_name(name, number);
    entry.name_key = name_key(entry.name);
  }
}

}  // namespace

std::string visible_name(const std::string& said) {
  std::string name;
  bool is_seen = false;
  for_each_character(showable(said, limits::person_name_bytes_max), [&](Look look, std::string_view bytes) {
    is_seen = is_seen || look == Look::seen;
    const bool has_none_before = name.empty() || name.ends_with(' ');
    if (look != Look::blank && (look == Look::seen || !has_none_before)) name += bytes;
    if (look == Look::blank && !has_none_before) name += ' ';
  });
  if (name.ends_with(' ')) name.pop_back();
  return is_seen && !is_as_nameless(name_key(name)) ? name : std::string();
}

std::string name_key(const std::string& name) {
  const std::unique_ptr<utf8proc_uint8_t, decltype(&std::free)> folded(
      utf8proc_NFKC_Casefold(reinterpret_cast<const utf8proc_uint8_t*>(name.c_str())), &std::free);
  CHECK(folded != nullptr);
  std::string key;
  for_each_character(reinterpret_cast<const char*>(folded.get()), [&](Look look, std::string_view bytes) {
    if (look == Look::seen || look == Look::mark) key += bytes;
  });
  return key;
}

std::string numbered_name(const std::string& name, size_t number) {
  const std::string behind = " (" + std::to_string(number) + ")";
  std::string cut = showable(name, limits::person_name_bytes_max - behind.size());
  while (cut.ends_with(' ')) cut.pop_back();
  return cut + behind;
}

void name_person(SessionTable& sessions, uint64_t session, Talk& talk) {
  SessionEntry& entry = sessions.at(session);
  give_name(sessions, session, entry);
  if (entry.name.empty() || !entry.grant.vouches_name) return;
  for (const auto& [id, other] : sessions.entries()) {
    if (id == session || other.grant.vouches_name || other.name_key != entry.name_key) continue;
    SessionEntry& renamed = sessions.at(id);
    give_name(sessions, id, renamed);
    talk.rename(id, renamed.name);
  }
}

}  // namespace scree
