#include "client/admin/console/line_editor.h"

#include <algorithm>
#include <clocale>
#include <cstdio>
#include <cstring>
#include <histedit.h>

#include "client/admin/console/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// A choice that ends so is followed by a value, not by a space.
constexpr char before_value = '=';
constexpr size_t columns = 80;

/// The bytes that all begin with.
std::string common_begin(const std::vector<std::string>& choices) {
  std::string begin = choices.front();
  for (const std::string& choice : choices) {
    const auto differ = std::ranges::mismatch(begin, choice).in1;
    begin.erase(differ, begin.end());
  }
  return begin;
}

void print_in_columns(const std::vector<std::string>& choices) {
  const size_t width = std::ranges::max(choices, {}, &std::string::size).size() + 2;
  const size_t per_line = std::max<size_t>(1, columns / width);
  for (size_t i = 0; i < choices.size(); ++i) {
    const bool ends_line = (i + 1) % per_line == 0 || i + 1 == choices.size();
    std::printf("%-*s%s", ends_line ? 0 : static_cast<int>(width), choices[i].c_str(), ends_line ? "\n" : "");
  }
}

}  // namespace

struct LineEditor::Library {
  EditLine* editor = nullptr;
  History* history = nullptr;
  std::string prompt;
  Complete complete;
  bool dropped = false;

  static Library& of(EditLine* editor) {
    void* self = nullptr;
    el_get(editor, EL_CLIENTDATA, &self);
    return *static_cast<Library*>(self);
  }
  static char* prompt_of(EditLine* editor) { return of(editor).prompt.data(); }
  static unsigned char drop(EditLine* editor, int) {
    of(editor).dropped = true;
    return CC_NEWLINE;
  }
  static unsigned char offer(EditLine* editor, int);
};

/// Types what all choices have in common, or shows them where that is typed already.
unsigned char LineEditor::Library::offer(EditLine* editor, int) {
  const LineInfo* const line = el_line(editor);
  const std::string_view typed(line->buffer, static_cast<size_t>(line->cursor - line->buffer));
  const Offer offer = of(editor).complete(typed);
  if (offer.choices.empty()) return CC_ERROR;
  std::string begin = common_begin(offer.choices);
  if (offer.choices.size() == 1 && !begin.ends_with(before_value)) begin += ' ';
  CHECK(begin.size() >= offer.typed_bytes);
  if (begin.size() > offer.typed_bytes)
    return el_insertstr(editor, begin.c_str() + offer.typed_bytes) == 0 ? CC_REFRESH : CC_ERROR;
  if (offer.choices.size() == 1) return CC_ERROR;
  std::printf("\n");
  print_in_columns(offer.choices);
  std::fflush(stdout);
  return CC_REDISPLAY;
}

/// Letters beyond ASCII are those of the environment's locale.
LineEditor::LineEditor(std::string prompt, Complete complete) : library_(std::make_unique<Library>()) {
  const char* const locale = std::setlocale(LC_CTYPE, "");
  if (locale == nullptr || std::strcmp(locale, "C") == 0) std::setlocale(LC_CTYPE, "C.UTF-8");
  library_->prompt = std::move(prompt);
  library_->complete = std::move(complete);
  library_->history = history_init();
  EditLine* const editor = library_->editor = el_init("scree-admin", stdin, stdout, stderr);
  CHECK(editor != nullptr && library_->history != nullptr);
  HistEvent ignored;
  history(library_->history, &ignored, H_SETSIZE, static_cast<int>(limits::typed_lines_kept));
  el_set(editor, EL_CLIENTDATA, library_.get());
  el_set(editor, EL_PROMPT, &Library::prompt_of);
  el_set(editor, EL_HIST, &::history, library_->history);
  el_set(editor, EL_EDITOR, "emacs");
  el_source(editor, nullptr);  // the person's own ~/.editrc
  el_set(editor, EL_ADDFN, "scree-offer", "Completes a word", &Library::offer);
  el_set(editor, EL_ADDFN, "scree-drop", "Drops the line", &Library::drop);
  el_set(editor, EL_BIND, "\t", "scree-offer", nullptr);
  el_set(editor, EL_BIND, "^R", "em-inc-search-prev", nullptr);
  el_set(editor, EL_SETTY, "-d", "-isig", nullptr);  // while a line is typed, Ctrl-C is a key as any other
  el_set(editor, EL_BIND, "^C", "scree-drop", nullptr);
}

LineEditor::~LineEditor() {
  el_end(library_->editor);
  history_end(library_->history);
}

LineEditor::Typed LineEditor::read() {
  library_->dropped = false;
  int bytes = 0;
  const char* const line = el_gets(library_->editor, &bytes);
  if (library_->dropped) return {End::dropped};
  if (line == nullptr || bytes <= 0) return {End::closed};
  std::string typed(line, static_cast<size_t>(bytes));
  if (typed.ends_with('\n')) typed.pop_back();
  return {End::line, std::move(typed)};
}

void LineEditor::remember(const std::string& line) {
  HistEvent ignored;
  history(library_->history, &ignored, H_ENTER, line.c_str());
}

}  // namespace scree
