#include <filesystem>
#include <fstream>
#include <unistd.h>

#include "tests/rules/sandbox_support.h"

namespace scree {
namespace {

class Folder {
 public:
  Folder() : path(std::filesystem::temp_directory_path() / ("scree_rules_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path / "mod" / "lib");
  }
  ~Folder() { std::filesystem::remove_all(path); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(path / name) << text; }

  ScriptOptions options() const {
    ScriptOptions made = small_options();
    made.folder = path / "mod";
    return made;
  }

  std::filesystem::path path;
};

TEST(Require, runs_a_file_once_and_gives_its_value) {
  const Folder folder;
  folder.write("mod/lib/util.lua", "runs = (runs or 0) + 1 return {name = ...}");
  Played played(folder.options());
  EXPECT_EQ(played.ask("require('lib/util').name, require('lib/util.lua') == require('lib/util'), runs"),
            "lib/util\ttrue\t1");
}

TEST(Require, names_files_without_the_machines_path) {
  const Folder folder;
  folder.write("mod/main.lua", "local lib = require('lib/bad')\nlib.fall()");
  folder.write("mod/lib/bad.lua", "return {fall = function()\n  error('fell')\nend}");
  Played played(folder.options());
  ScriptBudget budget{100'000, 1};
  const auto ended = played.script.load("main.lua", budget);
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().text(),
            "lib/bad.lua:2: fell\n  in global 'error'\n  lib/bad.lua:2: in field 'fall'\n  main.lua:2: in "
            "main chunk");
}

TEST(Require, of_itself_is_an_error) {
  const Folder folder;
  folder.write("mod/a.lua", "require('b')");
  folder.write("mod/b.lua", "require('a')");
  Played played(folder.options());
  EXPECT_EQ(played.ask("require('a')"), "! b.lua:1: require: module a requires itself, or failed before");
}

TEST(Require, errors_of_syntax_name_the_file) {
  const Folder folder;
  folder.write("mod/a.lua", "x =");
  Played played(folder.options());
  EXPECT_EQ(played.ask("require('a')"), "! a.lua:1: unexpected symbol near <eof>");
}

TEST(Require, stays_within_the_folder) {
  const Folder folder;
  folder.write("outside.lua", "return 'out'");
  folder.write("mod/in.lua", "return 'in'");
  std::filesystem::create_symlink(folder.path / "outside.lua", folder.path / "mod" / "link.lua");
  std::filesystem::create_symlink(folder.path, folder.path / "mod" / "up");
  std::filesystem::create_symlink("in.lua", folder.path / "mod" / "twin.lua");
  Played played(folder.options());
  for (const char* name : {"../outside", "lib/../../outside", "link", "up/outside", "/etc/passwd", "./in",
                           "lib//in", "", "a b", "in\\0", ".", "..", "lib/", "nothing", "lib"})
    EXPECT_EQ(played.ask("pcall(require, '" + std::string(name) + "')").substr(0, 5), "false") << name;
  EXPECT_EQ(played.ask("require('twin')"), "in");
  EXPECT_EQ(played.ask("require('../outside')"),
            "! console:1: \"../outside\" is no path within the script's folder");
  EXPECT_EQ(played.ask("require('link')"), "! console:1: file link.lua lies outside the script's folder");
  EXPECT_EQ(played.ask("require('nothing')"), "! console:1: there is no file nothing.lua");
}

TEST(Require, refuses_what_is_no_small_file) {
  const Folder folder;
  folder.write("mod/big.lua", "--" + std::string(size_t{1} << 20U, 'x'));
  folder.write("mod/bytecode.lua", "\x1bLua");
  std::filesystem::create_directory(folder.path / "mod" / "folder.lua");
  Played played(folder.options());
  EXPECT_EQ(played.ask("require('big')"), "! console:1: file big.lua is longer than 1048576 bytes");
  EXPECT_EQ(played.ask("require('bytecode')"), "! attempt to load a binary chunk (mode is 't')");
  EXPECT_EQ(played.ask("pcall(require, 'folder')").substr(0, 5), "false");
}

TEST(Require, of_a_text_that_compiles_slowly_ends_in_time) {
  const Folder folder;
  std::string branches = "if x then ";
  while (branches.size() < 1'000'000) branches += "elseif x then ";
  folder.write("mod/slow.lua", branches + "end");
  ScriptOptions options = folder.options();
  options.work_max = 1'000'000'000;
  options.cpu_max_s = 0.05;
  options.memory_max_bytes = size_t{64} << 20U;
  Played played(options);
  const double begin_s = thread_cpu_s();
  EXPECT_EQ(played.ask("require('slow')").find("! "), 0U);
  EXPECT_LE(thread_cpu_s() - begin_s, 0.2);
}

}  // namespace
}  // namespace scree
