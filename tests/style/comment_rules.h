// The comments of sources as running text, held to the rules of prose (prose_rules.h).
#pragma once

#include <string>
#include <vector>

#include "tests/style/style_rules.h"

namespace scree::style {

/// The paragraphs and list items of a source's comments. Indented lines are layouts of bytes, diagrams or
/// samples of code: they are left out, but for those that continue an item of a list.
std::vector<std::string> paragraphs_of_comments(const std::string& source);

/// The complaints about the sentences of a source's comments. Lengths do not count in .proto files, whose
/// comments specify bytes.
Complaints check_comments(const SourceFile& file);

}  // namespace scree::style
