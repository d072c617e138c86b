#include "client/admin/console/typed_words.h"

#include <fmt/format.h>
#include <utility>

#include "client/admin/console/limits.h"

namespace scree {

namespace {

/// What is open at the end of a line.
enum class Open { nothing, word, quote, escape, comment };

/// Takes the characters of a line, one after the other.
class WordSplitter {
 public:
  void take(char c) {
    if (escaped_) return take_escaped(c);
    if (quote_ != 0) return take_quoted(c);
    if (in_comment_) return;
    if (c == ' ' || c == '\t') return end_word();
    if (c == '#' && !in_word_) {
      in_comment_ = true;
      return;
    }
    in_word_ = true;
    if (c == '\'' || c == '"')
      quote_ = c;
    else if (c == '\\')
      escaped_ = true;
    else
      word_ += c;
    quoted_ = quoted_ || quote_ != 0 || escaped_;
  }
  void end_word() {
    if (in_word_) words_.push_back(std::exchange(word_, {}));
    in_word_ = quoted_ = false;
  }
  Open open() const {
    if (escaped_) return Open::escape;
    if (quote_ != 0) return Open::quote;
    return in_comment_ ? Open::comment : in_word_ ? Open::word : Open::nothing;
  }
  bool quoted() const { return quoted_; }
  std::vector<std::string>& words() { return words_; }
  std::string& word() { return word_; }

 private:
  /// Within double quotes a backslash stands for itself, unless a quote or a backslash follows.
  void take_escaped(char c) {
    if (quote_ != 0 && c != '"' && c != '\\') word_ += '\\';
    word_ += c;
    escaped_ = false;
  }
  void take_quoted(char c) {
    if (c == quote_)
      quote_ = 0;
    else if (c == '\\' && quote_ == '"')
      escaped_ = true;
    else
      word_ += c;
  }

  std::vector<std::string> words_;
  std::string word_;
  char quote_ = 0;  ///< 0: none is open
  bool in_word_ = false, escaped_ = false, in_comment_ = false, quoted_ = false;
};

}  // namespace

Result<std::vector<std::string>> split_words(std::string_view line) {
  if (line.size() > limits::typed_line_bytes_max)
    return fail(fmt::format("a line has at most {} bytes", limits::typed_line_bytes_max));
  WordSplitter splitter;
  for (const char c : line) splitter.take(c);
  if (splitter.open() == Open::quote) return fail("a quote is not closed");
  if (splitter.open() == Open::escape) return fail("nothing follows the last backslash");
  splitter.end_word();
  return std::move(splitter.words());
}

Typing typing_of(std::string_view line) {
  WordSplitter splitter;
  for (const char c : line) splitter.take(c);
  const bool quoted = splitter.quoted() || splitter.open() == Open::comment;
  return {std::move(splitter.words()), std::move(splitter.word()), quoted};
}

}  // namespace scree
