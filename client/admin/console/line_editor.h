// Reads lines from a terminal: with a prompt, cursor keys, earlier lines and completion by Tab. One at a time
// in a program, on one thread.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace scree {

class LineEditor {
 public:
  enum class End {
    line,     ///< Return
    dropped,  ///< Ctrl-C: the person begins again
    closed    ///< Ctrl-D on an empty line, or the terminal is gone
  };
  struct Typed {
    End end = End::closed;
    std::string line{};
  };
  /// What may come next where a line is typed up to here.
  struct Offer {
    size_t typed_bytes = 0;  ///< at the end of the line, of which each choice is a continuation
    std::vector<std::string> choices;
  };
  using Complete = std::function<Offer(std::string_view line)>;

  /// On standard input and output, which are a terminal.
  LineEditor(std::string prompt, Complete complete);
  ~LineEditor();
  LineEditor(const LineEditor&) = delete;
  LineEditor& operator=(const LineEditor&) = delete;

  /// Waits for a line.
  Typed read();
  /// An earlier line, to which the cursor keys go back.
  void remember(const std::string& line);

 private:
  struct Library;
  std::unique_ptr<Library> library_;
};

}  // namespace scree
