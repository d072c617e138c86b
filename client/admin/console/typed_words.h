// A typed line as words, split as a shell does it, without anything else that a shell does: 'as it stands',
// "with
// \" and \\", a\ b, and # at the begin of a word for what nobody reads. Pure functions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "shared/base/result.h"

namespace scree {

/// The words of a line. The error names what is left open.
Result<std::vector<std::string>> split_words(std::string_view line);

/// A line that is being typed, up to where the person is.
struct Typing {
  std::vector<std::string> before;  ///< the words that are ended
  std::string word;                 ///< the one that is not; may be empty
  bool quoted = false;              ///< its characters are not all as they were typed
};
Typing typing_of(std::string_view line);

}  // namespace scree
