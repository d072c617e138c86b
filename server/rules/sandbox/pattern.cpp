#include "server/rules/sandbox/pattern.h"

#include <array>
#include <bitset>
#include <optional>
#include <re2/re2.h>
#include <string>
#include <vector>

#include "server/rules/sandbox/script_limits.h"

namespace scree {
namespace {

using ByteSet = std::bitset<256>;

/// In the "C" locale, whatever the program's is.
bool in_range(int c, int low, int high) {
  return c >= low && c <= high;
}

bool is_letter(int c) {
  return in_range(c | 32, 'a', 'z') && c < 128;
}

/// Whether the class of a letter, "%a", has a byte; nothing where the letter names no class.
std::optional<bool> in_named_class(int c, char letter) {
  const bool digit = in_range(c, '0', '9');
  bool in = false;
  switch (letter | 32) {
    case 'a':
      in = is_letter(c);
      break;
    case 'c':
      in = c < 32 || c == 127;
      break;
    case 'd':
      in = digit;
      break;
    case 'g':
      in = in_range(c, 33, 126);
      break;
    case 'l':
      in = in_range(c, 'a', 'z');
      break;
    case 'p':
      in = in_range(c, 33, 126) && !is_letter(c) && !digit;
      break;
    case 's':
      in = c == ' ' || in_range(c, 9, 13);
      break;
    case 'u':
      in = in_range(c, 'A', 'Z');
      break;
    case 'w':
      in = is_letter(c) || digit;
      break;
    case 'x':
      in = digit || in_range(c | 32, 'a', 'f');
      break;
    case 'z':
      in = c == 0;
      break;
    default:
      return std::nullopt;
  }
  const bool complement = in_range(static_cast<unsigned char>(letter), 'A', 'Z');
  return in != complement;
}

bool in_escape(int c, char letter) {
  const bool named = is_letter(static_cast<unsigned char>(letter));
  const std::optional<bool> in = named ? in_named_class(c, letter) : std::nullopt;
  return in ? *in : c == static_cast<unsigned char>(letter);
}

void append_byte(std::string& program, unsigned byte) {
  static constexpr char digits[] = "0123456789abcdef";
  program += "\\x";
  program += digits[byte >> 4U];
  program += digits[byte & 15U];
}

/// A class of RE2 with these bytes.
std::string class_text(const ByteSet& bytes) {
  if (bytes.none()) return "[^\\x00-\\xff]";
  std::string text = "[";
  for (unsigned begin = 0; begin < 256; ++begin) {
    if (!bytes[begin]) continue;
    unsigned end = begin;
    while (end < 255 && bytes[end + 1]) ++end;
    append_byte(text, begin);
    if (end > begin) {
      text += '-';
      append_byte(text, end);
    }
    begin = end;
  }
  return text + "]";
}

}  // namespace

/// Reads a pattern as Lua's matcher does (lstrlib.c), and writes a program.
class PatternTranslator {
 public:
  PatternTranslator(std::string_view pattern, ScriptPattern& to) : pattern_(pattern), to_(to) {}

  Result<std::string> run(bool anchors) {
    if (anchors && pattern_.starts_with('^')) {
      to_.anchored_ = true;
      at_ = 1;
    }
    while (at_ < pattern_.size()) TRY(item());
    if (!open_.empty()) return fail("unfinished capture");
    return std::move(program_);
  }

 private:
  Result<void> item() {
    const char c = pattern_[at_];
    if (c == '(') return open();
    if (c == ')') return close();
    if (c == '$' && at_ + 1 == pattern_.size()) {
      program_ += "\\z";
      ++at_;
      return {};
    }
    const ByteSet bytes = TRY(single());
    program_ += class_text(bytes);
    ++to_.items_;
    if (at_ == pattern_.size()) return {};
    const char quantifier = pattern_[at_];
    if (quantifier == '*' || quantifier == '+' || quantifier == '?')
      program_ += quantifier;
    else if (quantifier == '-')
      program_ += "*?";
    else
      return {};
    ++at_;
    return {};
  }

  Result<void> open() {
    if (to_.captures_ == script_captures_max) return fail("too many captures");
    const bool place = pattern_.substr(at_).starts_with("()");
    to_.places_[to_.captures_++] = place;
    program_ += place ? "()" : "(";
    at_ += place ? 2 : 1;
    if (!place) open_.push_back(to_.captures_);
    return {};
  }

  Result<void> close() {
    if (open_.empty()) return fail("invalid pattern capture");
    open_.pop_back();
    program_ += ")";
    ++at_;
    return {};
  }

  Result<ByteSet> single() {
    const char c = pattern_[at_++];
    ByteSet bytes;
    if (c == '.') return bytes.set();
    if (c == '%') {
      if (at_ == pattern_.size()) return fail("malformed pattern (ends with '%')");
      const char letter = pattern_[at_++];
      if (letter == 'b' || letter == 'f' || in_range(letter, '0', '9'))
        return fail(std::string("%") + letter + " in a pattern is not available here");
      for (int i = 0; i < 256; ++i) bytes[static_cast<size_t>(i)] = in_escape(i, letter);
      return bytes;
    }
    if (c == '[') return set();
    bytes.set(static_cast<unsigned char>(c));
    return bytes;
  }

  /// The set whose '[' was just read.
  Result<ByteSet> set() {
    const bool complement = at_ < pattern_.size() && pattern_[at_] == '^';
    const size_t begin = at_ + (complement ? 1 : 0);
    size_t end = begin;
    do {
      if (end >= pattern_.size()) return fail("malformed pattern (missing ']')");
      const bool escape = pattern_[end++] == '%';
      if (escape) ++end;
    } while (end >= pattern_.size() || pattern_[end] != ']');
    at_ = end + 1;
    const std::string_view inner = pattern_.substr(begin, end - begin);
    ByteSet bytes;
    for (int c = 0; c < 256; ++c) bytes[static_cast<size_t>(c)] = in_set(c, inner) != complement;
    return bytes;
  }

  static bool in_set(int c, std::string_view inner) {
    for (size_t i = 0; i < inner.size(); ++i) {
      const int here = static_cast<unsigned char>(inner[i]);
      if (inner[i] == '%' && i + 1 < inner.size()) {
        if (in_escape(c, inner[++i])) return true;
      } else if (i + 2 < inner.size() && inner[i + 1] == '-') {
        i += 2;
        if (in_range(c, here, static_cast<unsigned char>(inner[i]))) return true;
      } else if (here == c) {
        return true;
      }
    }
    return false;
  }

  std::string_view pattern_;
  ScriptPattern& to_;
  size_t at_ = 0;
  std::string program_;
  std::vector<int> open_;
};

ScriptPattern::ScriptPattern() = default;
ScriptPattern::~ScriptPattern() = default;

Result<std::unique_ptr<ScriptPattern>> ScriptPattern::compile(std::string_view pattern, bool anchors) {
  if (pattern.size() > script_pattern_bytes_max)
    return fail("a pattern is longer than " + std::to_string(script_pattern_bytes_max) + " bytes");
  std::unique_ptr<ScriptPattern> made(new ScriptPattern);
  const std::string program = TRY(PatternTranslator(pattern, *made).run(anchors));
  re2::RE2::Options options;
  options.set_encoding(re2::RE2::Options::EncodingLatin1);
  options.set_log_errors(false);
  options.set_max_mem(static_cast<int64_t>(script_pattern_memory_bytes));
  made->program_ = std::make_unique<re2::RE2>(program, options);
  if (!made->program_->ok()) return fail("pattern too complex");
  return made;
}

bool ScriptPattern::find(std::string_view text, size_t from, Match& match) const noexcept {
  std::array<re2::StringPiece, script_captures_max + 1> found;
  const re2::StringPiece piece(text.data(), text.size());
  const auto anchor = anchored_ ? re2::RE2::ANCHOR_START : re2::RE2::UNANCHORED;
  const re2::StringPiece rest(piece.data() + from, piece.size() - from);
  if (!program_->Match(rest, 0, rest.size(), anchor, found.data(), captures_ + 1)) return false;
  const auto span = [&](const re2::StringPiece& part) {
    const auto begin = static_cast<size_t>(part.data() - text.data());
    return Span{begin, begin + part.size()};
  };
  match.whole = span(found[0]);
  for (int i = 0; i < captures_; ++i) match.captures[i] = span(found[static_cast<size_t>(i) + 1]);
  return true;
}

}  // namespace scree
