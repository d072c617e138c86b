// Facts that stand in one place alone: the version, and which suites draw.
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace scree::style {
namespace {

namespace fs = std::filesystem;

const fs::path source_root = SCREE_SOURCE_DIR;

std::string text_in(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The first group of each match.
std::vector<std::string> groups_in(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
    found.push_back((*it)[1]);
  return found;
}

std::string project_version() {
  const auto found =
      groups_in(text_in(source_root / "CMakeLists.txt"), std::regex(R"(project\(scree VERSION ([0-9.]+))"));
  return found.size() == 1 ? found.front() : "";
}

TEST(Project, the_changelog_begins_with_the_version) {
  ASSERT_FALSE(project_version().empty());
  const auto releases = groups_in(text_in(source_root / "CHANGELOG.md"), std::regex(R"(\n## ([0-9.]+))"));
  ASSERT_FALSE(releases.empty());
  EXPECT_EQ(releases.front(), project_version());
}

TEST(Project, no_script_or_page_repeats_the_version) {
  std::vector<fs::path> files = {"scree", "packages.txt", "CMakePresets.json", "README.md",
                                 "CONTRIBUTING.md"};
  for (const char* folder : {"docs", "docker", "cmake", "tools/scripts"})
    for (const auto& entry : fs::directory_iterator(source_root / folder))
      if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), source_root));
  for (const fs::path& file : files) {
    if (file == "docs/compatibility.md") continue;  // names the folders of files that each release wrote
    EXPECT_EQ(text_in(source_root / file).find(project_version()), std::string::npos) << file;
  }
}

/// Suites of a test's source.
std::set<std::string> suites_of(const std::string& text) {
  static const std::regex macro(R"((?:^|\n)TEST(?:_F|_P)?\(([A-Za-z0-9_]+),)");
  const auto found = groups_in(text, macro);
  return {found.begin(), found.end()};
}

TEST(Project, suites_that_draw_are_named_as_such) {
  static const std::regex drawing(
      R"(#include "(?:tests/support/(offscreen_fixture|run_viewer|viewer_window_fixture)|client/viewer/pictures/(egl_context))\.h")");
  const auto lists = groups_in(text_in(source_root / "tests/CMakeLists.txt"),
                               std::regex(R"(set\(DRAWING_SUITES ([A-Za-z \n]+)\))"));
  ASSERT_EQ(lists.size(), 1U);
  std::istringstream words(lists.front());
  const std::set<std::string> named{std::istream_iterator<std::string>(words), {}};
  size_t sources = 0;
  for (const auto& entry : fs::recursive_directory_iterator(source_root / "tests")) {
    if (!entry.path().string().ends_with("_test.cpp")) continue;
    const std::string text = text_in(entry.path());
    if (!std::regex_search(text, drawing)) continue;
    ++sources;
    for (const std::string& suite : suites_of(text))
      EXPECT_TRUE(named.contains(suite)) << suite << " of " << entry.path() << " is not in DRAWING_SUITES";
  }
  EXPECT_GE(sources, 10U);
}

}  // namespace
}  // namespace scree::style
