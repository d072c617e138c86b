// The length of functions, found without a compiler: literals and comments are blanked, then braces are
// followed. What opens a brace outside of any function decides what it is: a scope (namespace, type), data,
// or a function's body.
#include <algorithm>
#include <cctype>
#include <regex>

#include "tests/style/style_rules.h"

namespace scree::style {
namespace {

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Copies text, blanking what is no code. Positions and line breaks stay.
class Blanker {
 public:
  explicit Blanker(std::string_view text) : text_(text), out_(text) {}

  std::string run() {
    while (at_ < text_.size()) step();
    return std::move(out_);
  }

 private:
  void step() {
    if (next_is("//")) return blank_to(find_line_end());
    if (next_is("/*")) return blank_to(find_after("*/", at_ + 2));
    if (next_is("R\"") && !after_word()) return blank_raw_string();
    if (text_[at_] == '"') return blank_quoted('"');
    if (text_[at_] == '\'' && !after_word()) return blank_quoted('\'');  // not 1'000
    if (text_[at_] == '#' && at_line_start()) return blank_to(find_line_end());
    ++at_;
  }

  bool next_is(std::string_view s) const { return text_.substr(at_).starts_with(s); }
  bool after_word() const { return at_ > 0 && is_word(text_[at_ - 1]); }
  bool at_line_start() const {
    const size_t line = text_.rfind('\n', at_) + 1;  // npos + 1 = 0
    return text_.find_first_not_of(" \t", line) == at_;
  }
  size_t find_after(std::string_view what, size_t from) const {
    const size_t found = text_.find(what, from);
    return found == std::string_view::npos ? text_.size() : found + what.size();
  }
  /// The end of this line and of those that a backslash joins to it.
  size_t find_line_end() const {
    size_t end = text_.find('\n', at_);
    while (end != std::string_view::npos && end > 0 && text_[end - 1] == '\\')
      end = text_.find('\n', end + 1);
    return std::min(end, text_.size());
  }
  void blank_to(size_t end) {
    for (; at_ < end; ++at_)
      if (text_[at_] != '\n') out_[at_] = ' ';
  }
  void blank_quoted(char quote) {
    size_t end = at_ + 1;
    while (end < text_.size() && text_[end] != quote && text_[end] != '\n') end += text_[end] == '\\' ? 2 : 1;
    blank_to(std::min(end + 1, text_.size()));
  }
  void blank_raw_string() {
    const size_t open = text_.find('(', at_);
    if (open == std::string_view::npos) return blank_to(text_.size());
    const std::string close = ")" + std::string(text_.substr(at_ + 2, open - at_ - 2)) + "\"";
    blank_to(find_after(close, open));
  }

  std::string_view text_;
  std::string out_;
  size_t at_ = 0;
};

enum class Opens { scope, data, member_initialiser, function };

/// What a brace opens, from the declaration before it. Template parameters may say class, too: they go first.
Opens classify(std::string header) {
  static const std::regex angles("<[^<>]*>");
  static const std::regex scope_words(R"(\b(namespace|class|struct|union|enum|extern)\b)");
  static const std::regex constructor(R"(\)[^:]*[^:]:[^:])");
  static const std::regex function_end(R"((\)|\}|\bconst|\bnoexcept|\boverride|\bfinal|\bmutable)\s*$)");
  for (std::string last; last != header;) {
    last = header;
    header = std::regex_replace(header, angles, " ");
  }
  if (std::count(header.begin(), header.end(), '(') > std::count(header.begin(), header.end(), ')'))
    return Opens::member_initialiser;  // a default argument: as with those, the declaration goes on after it
  if (std::regex_search(header, scope_words)) return Opens::scope;
  if (header.find('(') == std::string::npos) return Opens::data;
  const bool complete = std::regex_search(header, function_end);
  if (!complete && std::regex_search(header + " ", constructor)) return Opens::member_initialiser;
  return Opens::function;
}

/// Follows the braces of blanked code.
class FunctionFinder {
 public:
  FunctionFinder(const SourceFile& file, const std::string& code) : file_(file), code_(code) {}

  Complaints run() {
    for (; at_ < code_.size(); ++at_) step(code_[at_]);
    return std::move(complaints_);
  }

 private:
  void step(char c) {
    if (c == '{') return open();
    if (c == '}' || c == ';') return start_declaration();
    if (header_.empty() && std::isspace(static_cast<unsigned char>(c)) != 0) {
      declaration_ = at_ + 1;
      return;
    }
    header_ += c == '\n' ? ' ' : c;
  }

  void open() {
    const Opens kind = classify(header_);
    if (kind == Opens::scope) return start_declaration();
    const size_t first = declaration_;
    at_ = matching_brace();
    if (kind == Opens::member_initialiser) {
      header_ += "{} ";
      return;
    }
    if (kind == Opens::function) report(first);
    start_declaration();
  }

  void start_declaration() {
    header_.clear();
    declaration_ = at_ + 1;
  }

  size_t matching_brace() const {
    int depth = 0;
    for (size_t i = at_; i < code_.size(); ++i) {
      if (code_[i] == '{') ++depth;
      if (code_[i] == '}' && --depth == 0) return i;
    }
    return code_.size() - 1;
  }

  void report(size_t first) {
    const auto begin = code_.begin();
    const auto end = begin + static_cast<std::ptrdiff_t>(at_);
    const auto lines = std::count(begin + static_cast<std::ptrdiff_t>(first), end, '\n') + 1;
    if (static_cast<size_t>(lines) <= function_lines_max) return;
    const auto line = std::count(begin, begin + static_cast<std::ptrdiff_t>(first), '\n') + 1;
    complaints_.push_back(file_.path + ":" + std::to_string(line) + ": a function of " +
                          std::to_string(lines) + " lines, over the " + std::to_string(function_lines_max) +
                          "; move its parts into helpers");
  }

  const SourceFile& file_;
  const std::string& code_;
  size_t at_ = 0;
  size_t declaration_ = 0;  ///< where the declaration that is being read starts
  std::string header_;      ///< its text up to here
  Complaints complaints_;
};

}  // namespace

std::string without_comments_and_literals(std::string_view text) {
  return Blanker(text).run();
}

Complaints check_function_lengths(const SourceFile& file) {
  const std::string code = without_comments_and_literals(file.text);
  return FunctionFinder(file, code).run();
}

}  // namespace scree::style
