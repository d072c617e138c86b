// The pages of the documentation, for the tests of their prose, links and paths.
#pragma once

#include <vector>

#include "tests/style/style_rules.h"

namespace scree::style {

/// README.md first, then all pages of docs/ but docs/report, which programs write; paths are from the root.
std::vector<SourceFile> documentation_pages();

}  // namespace scree::style
