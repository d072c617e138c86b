#include "tests/style/message_rules.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string_view>

#include "tests/style/prose_rules.h"

namespace scree::style {
namespace {

bool is_of_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

bool is_blank(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

/// Reads a source once, character by character.
class LiteralReader {
 public:
  explicit LiteralReader(std::string_view source) : source_(source) {}

  std::vector<Literal> run() {
    while (at_ < source_.size()) step();
    return std::move(literals_);
  }

 private:
  void step() {
    const std::string_view rest = source_.substr(at_);
    if (rest.starts_with("//")) return skip_past("\n");
    if (rest.starts_with("/*")) return skip_past("*/");
    if (rest.front() == '#' && begins_line_) return skip_directive();
    if (rest.starts_with("R\"") && (at_ == 0 || !is_of_name(source_[at_ - 1]))) return skip_raw();
    if (rest.front() == '"') return read_literal();
    if (rest.front() == '\'' && (at_ == 0 || !is_of_name(source_[at_ - 1]))) return skip_character();
    if (rest.front() == '(') calls_.push_back(is_option_call());
    if (rest.front() == ')' && !calls_.empty()) calls_.pop_back();
    if (!is_blank(rest.front())) adjacent_ = false;
    advance(1);
  }

  void advance(size_t count) {
    for (const size_t end = std::min(at_ + count, source_.size()); at_ < end; ++at_) {
      if (source_[at_] == '\n') ++line_;
      begins_line_ = source_[at_] == '\n' || (begins_line_ && is_blank(source_[at_]));
    }
  }

  void skip_past(std::string_view end) {
    const size_t found = source_.find(end, at_);
    advance(found == std::string_view::npos ? source_.size() : found + end.size() - at_);
  }

  void skip_directive() {
    bool goes_on = true;
    while (goes_on && at_ < source_.size()) {
      const size_t begin = at_;
      skip_past("\n");
      goes_on = source_.substr(begin, at_ - begin).ends_with("\\\n");
    }
  }

  void skip_raw() {
    const size_t open = source_.find('(', at_);
    if (open == std::string_view::npos) return advance(source_.size());
    skip_past(")" + std::string(source_.substr(at_ + 2, open - at_ - 2)) + "\"");
    adjacent_ = false;
  }

  void skip_character() {
    advance(source_.substr(at_ + 1, 1) == "\\" ? 3 : 2);
    skip_past("'");
    adjacent_ = false;
  }

  void read_literal() {
    if (!adjacent_) literals_.push_back({"", line_, !calls_.empty() && calls_.back()});
    advance(1);
    while (at_ < source_.size() && source_[at_] != '"') {
      const bool escaped = source_[at_] == '\\' && at_ + 1 < source_.size();
      if (escaped) advance(1);
      literals_.back().text += escaped && source_[at_] == 'n' ? '\n' : source_[at_];
      advance(1);
    }
    advance(1);
    adjacent_ = true;
  }

  /// Whether the parenthesis here opens the arguments of add_…(), or add_…<…>().
  bool is_option_call() const {
    std::string_view before = source_.substr(0, at_);
    if (before.ends_with('>')) before = before.substr(0, before.rfind('<'));
    size_t begin = before.size();
    while (begin > 0 && is_of_name(before[begin - 1])) --begin;
    return before.substr(begin).starts_with("add_");
  }

  std::string_view source_;
  size_t at_ = 0;
  size_t line_ = 1;
  bool begins_line_ = true;
  bool adjacent_ = false;    ///< only blanks and comments since a literal
  std::vector<bool> calls_;  ///< of each open parenthesis: whether it is an option's
  std::vector<Literal> literals_;
};

}  // namespace

std::vector<Literal> literals_of(const std::string& source) {
  return LiteralReader(source).run();
}

Complaints check_messages(const SourceFile& file) {
  Complaints complaints;
  if (file.path.starts_with("tests/")) return complaints;
  for (const Literal& literal : literals_of(file.text)) {
    const std::string where = file.path + ":" + std::to_string(literal.line);
    if (literal.in_option && literal.text.starts_with("of "))
      complaints.push_back(where + ": begins with \"of\"; name the thing in \"" + literal.text + "\"");
    std::istringstream lines(literal.text);
    for (std::string line; std::getline(lines, line);)
      for (const std::string& sentence : sentences_of(line))
        for (std::string& complaint : check_sentence(where, sentence))
          complaints.push_back(std::move(complaint));
  }
  return complaints;
}

}  // namespace scree::style
