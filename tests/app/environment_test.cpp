// Variables of the environment that are no option of any program are refused, and those of other programs are
// not.
#include "server/app/environment.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <set>

#include "tests/support/holds.h"

namespace scree {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> own{"SCREE_WORLD", "SCREE_SESSIONS_MAX", "SCREE_PORT"};

TEST(Environment, a_mistyped_variable_is_refused_with_the_right_name) {
  const std::array<const char*, 4> typo{"HOME=/root", "SCREE_PORT=1", "SCREE_SESSION_MAX=3", nullptr};
  const std::string fault = fault_in_environment(own, typo.data());
  EXPECT_TRUE(holds(fault, "SCREE_SESSION_MAX")) << fault;
  EXPECT_TRUE(holds(fault, "did you mean SCREE_SESSIONS_MAX?")) << fault;
  const std::array<const char*, 2> strange{"SCREE_CHEESE=yes", nullptr};
  const std::string unlike = fault_in_environment(own, strange.data());
  EXPECT_TRUE(holds(unlike, "SCREE_CHEESE")) << unlike;
  EXPECT_FALSE(holds(unlike, "did you mean")) << unlike;
}

TEST(Environment, other_names_and_other_programs_variables_are_let_be) {
  const std::array<const char*, 6> fine{"SCREEN=1",     "SCREE_WORLD=a", "SCREE_TOKEN=b",
                                        "SCREE_NAME=c", "MY_SCREE_X=d",  nullptr};
  EXPECT_EQ(fault_in_environment(own, fine.data()), "");
  EXPECT_EQ(fault_in_environment(own, nullptr), "");
}

/// The names that the pattern finds in files of these parts with these endings.
std::set<std::string> named_in(const std::vector<const char*>& parts, const std::set<std::string>& endings,
                               const std::regex& pattern) {
  std::set<std::string> names;
  for (const char* part : parts)
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(SCREE_SOURCE_DIR) / part)) {
      if (!entry.is_regular_file() || !endings.contains(entry.path().extension())) continue;
      std::ifstream file(entry.path());
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      for (auto match = std::sregex_iterator(text.begin(), text.end(), pattern);
           match != std::sregex_iterator(); ++match)
        names.insert((*match)[1]);
    }
  return names;
}

TEST(Environment, all_variables_of_other_programs_and_scripts_are_known) {
  std::set<std::string> known{"SCREE_PORT", "SCREE_PRESET", "SCREE_REPORT", "SCREE_SEED", "SCREE_TRACE"};
  for (const std::string_view name : variables_of_others()) known.emplace(name);
  const auto declared = named_in({"client", "auth", "tools", "bench", "studies"}, {".cpp", ".h"},
                                 std::regex("envname\\(\"(SCREE_[A-Z_]+)\"\\)"));
  const auto read = named_in({"tests", "tools"}, {".sh", ".js", ".mjs"},
                             std::regex("(?:process\\.env\\.|\\$\\{)(SCREE_[A-Z_]+)"));
  EXPECT_GT(declared.size(), 30U);
  EXPECT_GE(read.size(), 2U);
  for (const auto* names : {&declared, &read})
    for (const std::string& name : *names)
      EXPECT_TRUE(known.contains(name) || name.starts_with("SCREE_CI_")) << name;
}

}  // namespace
}  // namespace scree
