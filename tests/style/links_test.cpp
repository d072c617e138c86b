// Links between the pages lead to files and headings that exist, and so do the paths that pages about the
// sources name.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <sstream>

#include "tests/style/pages.h"

namespace scree::style {
namespace {

namespace fs = std::filesystem;

const fs::path source_folder = SCREE_SOURCE_DIR;

/// A heading's anchor, as GitHub makes it: lower case, without signs, with dashes for spaces.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_')
      anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (c == ' ')
      anchor += '-';
  }
  return anchor;
}

std::set<std::string> anchors_of(const fs::path& page) {
  std::set<std::string> anchors;
  std::ifstream in(page);
  bool fenced = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```")) fenced = !fenced;
    const size_t text = line.find_first_not_of('#');
    if (!fenced && text != 0 && text != std::string::npos && line[text] == ' ')
      anchors.insert(anchor_of(line.substr(text + 1)));
  }
  return anchors;
}

/// What is wrong with a link; empty: nothing, or it leads to another site.
std::string fault_of(const SourceFile& page, const std::string& target) {
  if (target.find("://") != std::string::npos) return {};
  const size_t sign = target.find('#');
  const std::string file = target.substr(0, sign);
  const fs::path path =
      file.empty() ? source_folder / page.path : (source_folder / page.path).parent_path() / file;
  if (!fs::exists(path)) return page.path + ": there is no " + target;
  if (sign == std::string::npos || anchors_of(path).contains(target.substr(sign + 1))) return {};
  return page.path + ": no heading is " + target;
}

TEST(Links, lead_to_files_and_headings_that_exist) {
  static const std::regex link(R"(\]\(([^) ]+)\)|<img src="([^"]+)\")");
  size_t found = 0;
  for (const SourceFile& page : documentation_pages())
    for (std::sregex_iterator it(page.text.begin(), page.text.end(), link), end; it != end; ++it, ++found)
      EXPECT_EQ(fault_of(page, (*it)[1].matched ? (*it)[1] : (*it)[2]), "");
  EXPECT_GT(found, 100U);
}

TEST(Links, a_missing_file_or_heading_is_caught) {
  const SourceFile readme{"README.md", ""};
  EXPECT_EQ(fault_of(readme, "docs/host.md"), "");
  EXPECT_EQ(fault_of(readme, "docs/host.md#tls"), "");
  EXPECT_NE(fault_of(readme, "docs/guest.md"), "");
  EXPECT_NE(fault_of(readme, "docs/host.md#no-such-heading"), "");
}

/// Whether a file or folder exists, of which `*` stands for any end.
bool exists(const std::string& path) {
  if (!path.ends_with('*')) return fs::exists(source_folder / path);
  const fs::path folder = (source_folder / path).parent_path();
  const std::string name = path.substr(path.rfind('/') + 1), start = name.substr(0, name.size() - 1);
  return fs::is_directory(folder) &&
         std::any_of(fs::directory_iterator(folder), fs::directory_iterator(),
                     [&](const auto& entry) { return entry.path().filename().string().starts_with(start); });
}

/// A path is one from the root that ends in a file's name, or in a folder's.
TEST(Links, the_paths_in_the_architecture_exist) {
  static const std::regex quoted("`([a-z_]+/[A-Za-z0-9_./*-]+)`");
  size_t found = 0;
  for (const SourceFile& page : documentation_pages()) {
    if (page.path != "docs/architecture.md" && !page.path.starts_with("docs/design/")) continue;
    for (std::sregex_iterator it(page.text.begin(), page.text.end(), quoted), end; it != end; ++it) {
      const std::string path = (*it)[1];
      if (!fs::is_directory(source_folder / path.substr(0, path.find('/'))))
        continue;  // of a client, of a build
      ++found;
      EXPECT_TRUE(exists(path)) << page.path << ": " << path;
    }
  }
  EXPECT_GT(found, 80U);
}

}  // namespace
}  // namespace scree::style
