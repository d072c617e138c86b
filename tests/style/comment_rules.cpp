#include "tests/style/comment_rules.h"

#include <regex>
#include <sstream>

#include "tests/style/prose_rules.h"

namespace scree::style {
namespace {

/// Collects the lines of comments into paragraphs.
class CommentReader {
 public:
  std::vector<std::string> run(const std::string& source) {
    std::istringstream lines(source);
    for (std::string line; std::getline(lines, line);) step(line);
    end();
    return std::move(paragraphs_);
  }

 private:
  void step(const std::string& line) {
    static const std::regex whole(R"(^\s*//+(.*)$)"), trailing(R"(^.*\S\s+///?<? (.*)$)");
    std::smatch match;
    if (std::regex_match(line, match, whole)) return add(match[1]);
    end();
    if (line.find("//") != std::string::npos && std::regex_match(line, match, trailing)) {
      add(" " + match[1].str());
      end();
    }
  }

  void add(const std::string& text) {
    const size_t blanks = text.find_first_not_of(' ');
    if (blanks == std::string::npos) return end();
    std::string words = text.substr(blanks);
    if (const bool item = words.starts_with("- "); item || (blanks > 1 && !in_item_)) {
      end();
      if (!item) return;  // a layout
      in_item_ = true;
      words.erase(0, 2);
    } else if (in_item_ && blanks < 2) {
      end();
    }
    paragraph_ += (paragraph_.empty() ? "" : " ") + words;
  }

  void end() {
    if (words_in(paragraph_) > 0) paragraphs_.push_back(paragraph_);
    paragraph_.clear();
    in_item_ = false;
  }

  std::vector<std::string> paragraphs_;
  std::string paragraph_;
  bool in_item_ = false;
};

}  // namespace

std::vector<std::string> paragraphs_of_comments(const std::string& source) {
  return CommentReader().run(source);
}

Complaints check_comments(const SourceFile& file) {
  const bool specifies = file.path.ends_with(".proto");
  Complaints complaints;
  size_t words = 0, sentences = 0;
  for (const std::string& paragraph : paragraphs_of_comments(file.text))
    for (const std::string& sentence : sentences_of(paragraph)) {
      words += words_in(sentence);
      ++sentences;
      if (specifies && words_in(sentence) > sentence_words_max) continue;
      for (std::string& complaint : check_sentence(file.path, sentence))
        complaints.push_back(std::move(complaint));
    }
  if (!specifies && words > sentence_words_mean_max * sentences)
    complaints.push_back(file.path + ": " + std::to_string(words) + " words in " + std::to_string(sentences) +
                         " sentences of comments, over a mean of " + std::to_string(sentence_words_mean_max));
  return complaints;
}

}  // namespace scree::style
