// Patterns of Lua as programs of RE2, which match in time linear in the text. Results are those of Lua's own
// matcher: both prefer the same one of several matches.
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

#include "shared/base/result.h"

namespace re2 {
class RE2;
}

namespace scree {

/// As Lua's own LUA_MAXCAPTURES.
inline constexpr int script_captures_max = 32;

class ScriptPattern {
 public:
  /// What lies between two places of a text.
  struct Span {
    size_t begin = 0;
    size_t end = 0;
  };
  /// The whole match, and what each pair of parentheses captured.
  struct Match {
    Span whole;
    Span captures[script_captures_max];
  };

  /// `anchors`: whether '^' at the begin is an anchor, as it is but in gmatch().
  static Result<std::unique_ptr<ScriptPattern>> compile(std::string_view pattern, bool anchors);
  ~ScriptPattern();

  /// The first match at or after `from`. Allocates outside Lua, at most script_pattern_memory_bytes in all.
  bool find(std::string_view text, size_t from, Match& match) const noexcept;

  bool anchored() const { return anchored_; }
  int captures() const { return captures_; }
  /// Whether the capture is a place, `()`, not a text.
  bool is_place(int capture) const { return places_[capture]; }
  /// Characters and classes: how much work a byte of the text may take.
  int items() const { return items_; }

 private:
  friend class PatternTranslator;
  ScriptPattern();

  std::unique_ptr<re2::RE2> program_;
  bool anchored_ = false;
  int captures_ = 0;
  int items_ = 0;
  bool places_[script_captures_max] = {};
};

}  // namespace scree
