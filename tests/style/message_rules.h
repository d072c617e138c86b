// The texts that programs say (help, logs, errors, reports), held to the rules of prose (prose_rules.h). They
// are the string literals of sources.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/style/style_rules.h"

namespace scree::style {

/// A string literal; adjacent ones are one, as the compiler has it.
struct Literal {
  std::string text;        ///< without escapes
  size_t line = 1;         ///< of its first quote
  bool in_option = false;  ///< an argument of a call of add_…(), which declares options and commands
};

/// All but raw ones, which hold programs for shaders and scripts; and none of includes and macros.
std::vector<Literal> literals_of(const std::string& source);

/// The complaints about the sentences of a source's literals. A description of an option must not begin with
/// "of" either. Tests say nothing to users, so their literals may be anything.
Complaints check_messages(const SourceFile& file);

}  // namespace scree::style
