#include "tests/style/prose_rules.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <regex>
#include <sstream>

namespace scree::style {
namespace {

bool is_space(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

/// Whether a sentence may end here: not in the full stop of an abbreviation.
bool ends_sentence(std::string_view text, size_t stop) {
  static constexpr std::array abbreviations = {"e.g.", "i.e.", "etc.", "vs.", "cf."};
  size_t next = stop + 1;
  while (next < text.size() && std::string_view(")\"'*_").find(text[next]) != std::string_view::npos) ++next;
  if (next < text.size() && !is_space(text[next])) return false;
  const std::string_view before = text.substr(0, stop + 1);
  return std::none_of(abbreviations.begin(), abbreviations.end(),
                      [&](std::string_view word) { return before.ends_with(word); });
}

/// Turns of phrase that readers asked about, and what to write in their place.
struct Phrase {
  std::string_view words;
  std::string_view instead;
};
constexpr std::array phrases = {Phrase{"whoever", "name the person or the program"},
                                Phrase{"stands over", "overrides"}, Phrase{"stand over", "override"},
                                Phrase{"unless said", "by default"}};

size_t columns_of(const std::string& line) {
  return static_cast<size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

/// Text without the marks around it: links keep their words, code becomes one word.
std::string without_markup(std::string text) {
  static const std::regex code("`[^`]*`"), address(R"(\]\([^)]*\))"), html("<[^>]*>"), bracket(R"(!?\[)");
  static const std::regex heading_words(R"(^\*\*[^*]*[.:]\*\*)");
  text = std::regex_replace(text, heading_words, "");
  text = std::regex_replace(text, code, "code");
  text = std::regex_replace(text, address, "");
  text = std::regex_replace(text, html, "");
  text = std::regex_replace(text, bracket, "");
  text.erase(std::remove(text.begin(), text.end(), '*'), text.end());
  return text;
}

/// Reads a page line by line.
class PageReader {
 public:
  PageText run(std::string_view markdown) {
    std::istringstream lines{std::string(markdown)};
    for (std::string line; std::getline(lines, line);) step(line);
    end_paragraph();
    return std::move(page_);
  }

  /// Whether the line that was read last is prose: its length counts.
  bool in_prose() const { return prose_; }

  void step(const std::string& line) {
    prose_ = false;
    if (line.starts_with("```") || (comment_ = comment_ || line.starts_with("<!--"))) {
      if (comment_)
        comment_ = line.find("-->") == std::string::npos;
      else
        fenced_ = !fenced_;
      return end_paragraph();
    }
    if (fenced_ || (line.starts_with("    ") && paragraph_.empty())) return;
    if (line.empty() || line.starts_with('#') || line.starts_with('<')) return end_paragraph();
    if (line.starts_with('|')) return table_row(line);
    static const std::regex item(R"(^ *([-*]|[0-9]+\.) +)");
    std::smatch match;
    if (std::regex_search(line, match, item) || line.starts_with("![")) end_paragraph();
    prose_ = true;
    paragraph_ += (paragraph_.empty() ? "" : " ") + line.substr(match.empty() ? 0 : match.length());
  }

 private:
  void end_paragraph() {
    if (const std::string text = without_markup(std::move(paragraph_)); words_in(text) > 0)
      page_.paragraphs.push_back(text);
    paragraph_.clear();
  }

  void table_row(const std::string& line) {
    end_paragraph();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, '|');)
      if (const std::string text = without_markup(cell); words_in(text) > 0) page_.cells.push_back(text);
  }

  PageText page_;
  std::string paragraph_;
  bool fenced_ = false;
  bool comment_ = false;
  bool prose_ = false;
};

Complaints check_lines(const SourceFile& page) {
  static const std::regex address(R"(\]\([^)]*\))");
  Complaints complaints;
  PageReader reader;
  std::istringstream lines(page.text);
  size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    reader.step(line);
    const size_t columns = columns_of(std::regex_replace(line, address, ""));
    if (reader.in_prose() && columns > prose_columns_max)
      complaints.push_back(page.path + ":" + std::to_string(number) + ": " + std::to_string(columns) +
                           " columns, over the " + std::to_string(prose_columns_max) + " of a line");
  }
  return complaints;
}

}  // namespace

std::vector<std::string> sentences_of(std::string_view text) {
  std::vector<std::string> sentences;
  std::string sentence;
  const auto end = [&] {
    if (words_in(sentence) > 0) sentences.push_back(sentence);
    sentence.clear();
  };
  for (size_t i = 0; i < text.size(); ++i) {
    if (sentence.empty() && is_space(text[i])) continue;
    sentence += is_space(text[i]) ? ' ' : text[i];
    if ((text[i] == '.' || text[i] == '!' || text[i] == '?') && ends_sentence(text, i)) end();
  }
  end();
  return sentences;
}

size_t words_in(std::string_view sentence) {
  std::istringstream words{std::string(sentence)};
  size_t count = 0;
  for (std::string word; words >> word;)
    if (std::any_of(
            word.begin(), word.end(),
            [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || (c & 0x80) != 0; }) &&
        word != "–" && word != "—" && word != "…" && word != "→")
      ++count;
  return count;
}

PageText text_of_page(std::string_view markdown) {
  return PageReader().run(markdown);
}

Complaints check_sentence(const std::string& where, const std::string& sentence) {
  Complaints complaints;
  const std::string said = " in \"" + sentence + "\"";
  const size_t words = words_in(sentence);
  if (words > sentence_words_max)
    complaints.push_back(where + ": " + std::to_string(words) + " words, over the " +
                         std::to_string(sentence_words_max) + " of a sentence" + said);
  if (sentence.starts_with("Of "))
    complaints.push_back(where + ": begins with \"Of\"; begin with the subject" + said);
  std::string lower = sentence;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Phrase& phrase : phrases)
    if (lower.find(phrase.words) != std::string::npos)
      complaints.push_back(where + ": \"" + std::string(phrase.words) + "\" (" + std::string(phrase.instead) +
                           ")" + said);
  return complaints;
}

Complaints check_page(const SourceFile& page) {
  Complaints complaints = check_lines(page);
  const PageText text = text_of_page(page.text);
  const auto check_all = [&](const std::string& block) {
    const std::vector<std::string> sentences = sentences_of(block);
    for (const std::string& sentence : sentences)
      for (std::string& complaint : check_sentence(page.path, sentence))
        complaints.push_back(std::move(complaint));
    return sentences.size();
  };
  size_t words = 0, sentences = 0;
  for (const std::string& paragraph : text.paragraphs) {
    words += words_in(paragraph);
    sentences += check_all(paragraph);
  }
  for (const std::string& cell : text.cells) check_all(cell);
  if (words > sentence_words_mean_max * sentences)
    complaints.push_back(page.path + ": " + std::to_string(words) + " words in " + std::to_string(sentences) +
                         " sentences, over a mean of " + std::to_string(sentence_words_mean_max));
  return complaints;
}

}  // namespace scree::style
