// The source tree keeps the house rules; and the rules catch samples that break them.
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <regex>
#include <sstream>

#include "tests/style/comment_rules.h"
#include "tests/style/message_rules.h"
#include "tests/style/style_rules.h"

namespace scree::style {
namespace {

constexpr std::array source_folders = {"shared/", "proto/",   "crypto/",  "transport/", "auth/",
                                       "ground/", "content/", "server/",  "client/",    "tools/",
                                       "tests/",  "bench/",   "studies/", "python/"};

bool is_code(const std::string& path) {
  return path.ends_with(".h") || path.ends_with(".cpp");
}

bool is_source(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  const std::array extensions = {".h", ".cpp", ".glsl", ".vert", ".frag", ".geom", ".comp", ".proto"};
  return std::any_of(source_folders.begin(), source_folders.end(),
                     [&](auto folder) { return path.starts_with(folder); }) &&
         std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

/// What git knows or would add, so that scratch files which it ignores are not judged. Empty without git.
std::vector<std::string> paths_from_git(const std::filesystem::path& root) {
  const std::string command =
      "git -C '" + root.string() + "' ls-files --cached --others --exclude-standard 2>/dev/null";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::vector<std::string> paths;
  if (pipe == nullptr) return paths;
  std::array<char, 4096> line{};
  while (std::fgets(line.data(), line.size(), pipe.get()) != nullptr) {
    std::string path = line.data();
    path.erase(path.find_last_not_of('\n') + 1);
    paths.push_back(path);
  }
  return paths;
}

std::vector<std::string> paths_from_folders(const std::filesystem::path& root) {
  std::vector<std::string> paths;
  for (const char* folder : source_folders)
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder))
      paths.push_back(std::filesystem::relative(entry.path(), root).generic_string());
  return paths;
}

const std::vector<SourceFile>& source_files() {
  static const std::vector<SourceFile> files = [] {
    const std::filesystem::path root = SCREE_SOURCE_DIR;
    std::vector<std::string> paths = paths_from_git(root);
    if (paths.empty()) paths = paths_from_folders(root);
    std::vector<SourceFile> found;
    for (const std::string& path : paths) {
      std::ifstream in(root / path, std::ios::binary);
      if (!is_source(path) || !in) continue;
      std::ostringstream text;
      text << in.rdbuf();
      found.push_back({path, text.str()});
    }
    return found;
  }();
  return files;
}

std::string listed(const Complaints& complaints) {
  std::string text;
  for (const std::string& complaint : complaints) text += "\n  " + complaint;
  return text;
}

template <typename Check>
Complaints over_tree(Check check, bool code_only) {
  Complaints all;
  for (const SourceFile& file : source_files()) {
    if (code_only && !is_code(file.path)) continue;
    for (std::string& complaint : check(file)) all.push_back(std::move(complaint));
  }
  return all;
}

void expect_clean(const Complaints& complaints) {
  EXPECT_TRUE(complaints.empty()) << listed(complaints);
}

// ---- the tree

TEST(Style, the_tree_is_found) {
  EXPECT_GE(source_files().size(), 50U) << "in " << SCREE_SOURCE_DIR;
}
TEST(Style, comments_are_plain_english) {
  expect_clean(over_tree(check_comments, false));
}
TEST(Style, messages_are_plain_english) {
  expect_clean(over_tree(check_messages, true));
}
TEST(Style, files_are_short) {
  expect_clean(over_tree(check_file_length, false));
}
TEST(Style, functions_are_short) {
  expect_clean(over_tree(check_function_lengths, false));
}
TEST(Style, headers_are_guarded) {
  expect_clean(over_tree(check_pragma_once, true));
}
TEST(Style, dependencies_point_one_way) {
  expect_clean(over_tree(check_layering, true));
}
TEST(Style, libraries_stay_in_their_homes) {
  expect_clean(over_tree(check_library_homes, true));
}
TEST(Style, headers_hide_libraries) {
  expect_clean(check_library_leaks(source_files()));
}
TEST(Style, no_two_headers_define_a_class_of_the_same_name) {
  expect_clean(check_class_names(source_files()));
}
TEST(Style, kernels_use_exact_arithmetic) {
  expect_clean(over_tree(check_kernel_arithmetic, true));
}
TEST(Style, methods_are_told_apart_by_their_tables_alone) {
  expect_clean(over_tree(check_methods_are_asked, true));
}

std::string text_of(const std::string& path) {
  std::ifstream in(std::filesystem::path(SCREE_SOURCE_DIR) / path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The lines that match, by the first of the pattern's two groups.
std::map<std::string, std::string> rows_of(const std::string& text, const std::regex& pattern) {
  std::map<std::string, std::string> rows;
  std::istringstream lines(text);
  std::smatch match;
  for (std::string line; std::getline(lines, line);)
    if (std::regex_match(line, match, pattern)) rows[match[1]] = match[2];
  return rows;
}

/// A reason that begins with "tests: " keeps a package from all but ./scree test: npm alone brings hundreds.
TEST(Style, every_package_has_a_reason) {
  const std::string text = text_of("packages.txt");
  const auto packages = rows_of(text, std::regex(R"(([a-z0-9.+-]+) +# (.+))"));
  const auto lines = std::ranges::count(text, '\n');
  const auto comments = static_cast<ptrdiff_t>(rows_of(text, std::regex("(# .*)()")).size());
  EXPECT_EQ(static_cast<ptrdiff_t>(packages.size()), lines - comments) << "a line has no reason";
  for (const char* name : {"nodejs", "npm", "xvfb"}) EXPECT_TRUE(packages.at(name).starts_with("tests: "));
}

// ---- the rules

SourceFile function_of(size_t lines, const std::string& head) {
  SourceFile file{"shared/base/sample.cpp", head + " {\n"};
  for (size_t i = 2; i < lines; ++i) file.text += "  if (x) { y(); }\n";
  file.text += "}\n";
  return file;
}

TEST(StyleRules, a_file_over_the_limit_is_caught) {
  SourceFile file{"shared/base/a.cpp", std::string(file_lines_max, '\n')};
  EXPECT_TRUE(check_file_length(file).empty());
  file.text += '\n';
  EXPECT_EQ(check_file_length(file).size(), 1U);
}

TEST(StyleRules, a_long_function_is_caught_in_every_form) {
  const std::vector<std::string> heads = {
      "void f()",
      "int Name::f(const std::vector<int>& a) const",
      "template <class T> auto f(T t) -> std::vector<T>",
      "namespace a {\nstruct B final : C {\n  B() : a_{1}, b_{f({2})}, c_(3)",
      "TEST(Some, name)",
      "void f(Options o = {}, int n = 1'000)",
      "const auto f = [](int x)",
      "constexpr std::array<int, 2> table = {{1, 2}};\n#define M(x) { x\nbool g()",
      "// { \"\nconst char* s = \"{\"; const char* r = R\"x({ )\" {)x\"; char c = '{'; int h()",
  };
  for (const std::string& head : heads) {
    const size_t head_lines = static_cast<size_t>(std::count(head.begin(), head.end(), '\n'));
    const SourceFile good = function_of(function_lines_max - head_lines, head);
    const SourceFile bad = function_of(function_lines_max + 1, head);
    EXPECT_TRUE(check_function_lengths(good).empty()) << head << listed(check_function_lengths(good));
    EXPECT_EQ(check_function_lengths(bad).size(), 1U) << head;
  }
}

TEST(StyleRules, types_namespaces_and_data_are_no_functions) {
  const std::string filler(200, '\n');
  for (const std::string head : {"namespace a {", "class alignas(64) A : public B {", "enum class E : int {",
                                 "const int table[] = {", "template <class T> struct S {"})
    EXPECT_TRUE(check_function_lengths({"shared/base/a.h", head + filler + "};\n"}).empty()) << head;
}

TEST(StyleRules, a_header_without_guard_is_caught) {
  EXPECT_EQ(check_pragma_once({"proto/a.h", "// #pragma once\nint a;\n"}).size(), 1U);
  EXPECT_TRUE(check_pragma_once({"proto/a.h", "// A.\n#pragma once\n"}).empty());
  EXPECT_TRUE(check_pragma_once({"proto/a.cpp", "int a;\n"}).empty());
}

size_t layering_complaints(const std::string& path, const std::string& included) {
  return check_layering({path, "#include \"" + included + "\"\n"}).size();
}

TEST(StyleRules, an_upward_or_sideways_include_is_caught) {
  EXPECT_EQ(layering_complaints("shared/field/a.cpp", "proto/messages.h"), 1U);
  EXPECT_EQ(layering_complaints("proto/a.cpp", "server/world/world.h"), 1U);
  EXPECT_EQ(layering_complaints("server/bodies/a.cpp", "server/fracture/hull.h"), 1U);
  EXPECT_EQ(layering_complaints("server/world/a.cpp", "server/net/client_session.h"), 1U);
  EXPECT_EQ(layering_complaints("server/app/a.cpp", "client/mirror/mirror.h"), 1U);
  EXPECT_EQ(layering_complaints("client/viewer/a.cpp", "server/world/world.h"), 1U);
  EXPECT_EQ(layering_complaints("client/mirror/a.cpp", "client/connection/connection.h"), 1U);
  EXPECT_EQ(layering_complaints("server/world/a.cpp", "tests/scenes.h"), 1U);
}

TEST(StyleRules, a_downward_include_is_allowed) {
  EXPECT_EQ(layering_complaints("server/world/a.cpp", "server/bodies/bodies.h"), 0U);
  EXPECT_EQ(layering_complaints("server/world/a.cpp", "server/world/world.h"), 0U);
  EXPECT_EQ(layering_complaints("client/viewer/a.cpp", "client/render/scene/camera.h"), 0U);
  EXPECT_EQ(layering_complaints("tests/a.cpp", "server/net/client_session.h"), 0U);
}

TEST(StyleRules, an_include_that_is_no_path_from_the_root_is_caught) {
  EXPECT_EQ(layering_complaints("server/world/a.cpp", "world.h"), 1U);
  EXPECT_EQ(layering_complaints("server/world/a.cpp", "../bodies/bodies.h"), 1U);
}

TEST(StyleRules, a_folder_outside_the_layers_is_caught) {
  EXPECT_EQ(check_layering({"server/extras/a.cpp", ""}).size(), 1U);
  EXPECT_EQ(check_layering({"client/render/extras/a.cpp", ""}).size(), 1U);
  EXPECT_TRUE(check_layering({"client/render/mesh/extras/a.cpp", ""}).empty());
  EXPECT_TRUE(check_layering({"client/render/a.cpp", ""}).empty());
}

size_t home_complaints(const std::string& path, const std::string& included) {
  return check_library_homes({path, "#include " + included + "\n"}).size();
}

TEST(StyleRules, a_library_away_from_home_is_caught) {
  EXPECT_EQ(home_complaints("server/world/a.cpp", "<openvdb/openvdb.h>"), 1U);
  EXPECT_EQ(home_complaints("server/world/a.cpp", "<btBulletDynamicsCommon.h>"), 1U);
  EXPECT_EQ(home_complaints("server/bodies/a.cpp", "<voro++/voro++.hh>"), 1U);
  EXPECT_EQ(home_complaints("server/replay/a.cpp", "<sqlite3.h>"), 1U);
  EXPECT_EQ(home_complaints("client/render/a.cpp", "<imgui.h>"), 1U);
  EXPECT_EQ(home_complaints("client/mirror/a.cpp", "<epoxy/gl.h>"), 1U);
  EXPECT_EQ(home_complaints("client/bot/a.cpp", "<asio.hpp>"), 1U);
  EXPECT_EQ(home_complaints("server/net/a.cpp", "\"proto/scree.pb.h\""), 1U);
  EXPECT_EQ(home_complaints("shared/base/a.h", "<fmt/format.h>"), 1U);
}

TEST(StyleRules, a_library_at_home_is_allowed) {
  EXPECT_EQ(home_complaints("server/field/a.cpp", "<openvdb/openvdb.h>"), 0U);
  EXPECT_EQ(home_complaints("proto/a.cpp", "\"proto/scree.pb.h\""), 0U);
  EXPECT_EQ(home_complaints("shared/base/a.h", "<glm/vec3.hpp>"), 0U);
  EXPECT_EQ(home_complaints("shared/base/a.h", "<vector>"), 0U);
}

TEST(StyleRules, a_header_that_shows_a_library_to_another_folder_is_caught) {
  const SourceFile header{"server/bodies/shapes.h", "#include <btBulletDynamicsCommon.h>\n"};
  const SourceFile inside{"server/bodies/shapes.cpp", "#include \"server/bodies/shapes.h\"\n"};
  const SourceFile outside{"server/world/world.cpp", "#include \"server/bodies/shapes.h\"\n"};
  EXPECT_TRUE(check_library_leaks({header, inside}).empty());
  EXPECT_EQ(check_library_leaks({header, inside, outside}).size(), 1U);
}

TEST(StyleRules, a_class_of_two_headers_is_caught) {
  const SourceFile server{"server/net/a.h", "namespace scree {\nclass Link final : public Base {\n};\n}\n"};
  const SourceFile client{"client/viewer/b.h", "namespace scree {\nstruct Link {\n};\n}\n"};
  const SourceFile declares{"client/viewer/c.h",
                            "namespace scree {\nclass Link;\nstruct A {\n  struct Link {};\n};\n"};
  const SourceFile member{"client/viewer/d.h", "struct Link::State {\n};\n"};
  EXPECT_TRUE(check_class_names({server, declares, member}).empty());
  EXPECT_EQ(check_class_names({server, client}).size(), 1U);
}

TEST(StyleRules, a_library_function_in_a_kernel_is_caught) {
  EXPECT_EQ(check_kernel_arithmetic({"shared/field/a.cpp", "float f() { return std::sin(1.0F); }"}).size(),
            1U);
  EXPECT_TRUE(
      check_kernel_arithmetic({"shared/field/a.cpp", "// std::sin(\nfloat a = std::sqrt(b);"}).empty());
}

TEST(StyleRules, a_method_is_compared_in_its_table_alone) {
  const std::string branch = "int f(Cutter c) { return c == Cutter::slice ? 1 : 0; }";
  EXPECT_EQ(check_methods_are_asked({"shared/operation/a.cpp", branch}).size(), 1U);
  EXPECT_TRUE(check_methods_are_asked({"shared/fracture/cutter.h", branch}).empty());
  EXPECT_TRUE(check_methods_are_asked({"tests/fracture/a.cpp", branch}).empty());
  EXPECT_EQ(
      check_methods_are_asked({"client/viewer/window/a.cpp", "if (entry.name == \"grid\") f();"}).size(), 1U);
  EXPECT_TRUE(check_methods_are_asked({"server/work/a.cpp", "Cutter wanted = Cutter::slice;"}).empty());
}

}  // namespace
}  // namespace scree::style
