#include "tests/style/pages.h"

#include <filesystem>
#include <fstream>
#include <sstream>

namespace scree::style {

std::vector<SourceFile> documentation_pages() {
  namespace fs = std::filesystem;
  const fs::path root = SCREE_SOURCE_DIR;
  std::vector<SourceFile> found;
  const auto add = [&](const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    found.push_back({fs::relative(path, root).generic_string(), text.str()});
  };
  for (const char* page : {"README.md", "CONTRIBUTING.md", "CHANGELOG.md"}) add(root / page);
  for (const auto& entry : fs::recursive_directory_iterator(root / "docs")) {
    const std::string path = fs::relative(entry.path(), root).generic_string();
    if (path.ends_with(".md") && !path.starts_with("docs/report/")) add(entry.path());
  }
  return found;
}

}  // namespace scree::style
