#include "tools/rules/check_folder.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <sstream>
#include <tuple>

#include "server/rules/mod.h"
#include "tools/film/process/program_run.h"
#include "tools/rules/field_check.h"
#include "tools/rules/known_names.h"
#include "tools/rules/written_file.h"

namespace scree {

namespace {

namespace fs = std::filesystem;

/// luacheck ends with 1 or 2 where it found something, and with more where it could not look.
constexpr int luacheck_found_max = 2;

int number_at(std::string_view text) {
  int number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// The fault of "file:line:column: words", or of "file:line: words".
FolderFault fault_of_line(std::string_view text) {
  FolderFault fault;
  const size_t file = text.find(':');
  const size_t line = file == std::string_view::npos ? file : text.find(':', file + 1);
  if (line == std::string_view::npos) return {.file = {}, .words = std::string(text)};
  fault.file = text.substr(0, file);
  fault.line = number_at(text.substr(file + 1));
  text.remove_prefix(line + 1);
  if (const size_t column = text.find(':'); column != std::string_view::npos)
    if (const int number = number_at(text); number > 0) {
      fault.column = number;
      text.remove_prefix(column + 1);
    }
  fault.words = text.substr(text.find_first_not_of(' '));
  return fault;
}

/// A folder that goes with the object.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string pattern = (fs::temp_directory_path() / "scree-rules-XXXXXX").string();
    if (::mkdtemp(pattern.data()) != nullptr) path_ = pattern;
  }
  ~ScratchFolder() {
    std::error_code error;
    if (!path_.empty()) fs::remove_all(path_, error);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

Result<std::vector<FolderFault>> luacheck(const std::string& folder, const ScratchFolder& scratch) {
  const std::string config = scratch.path() + "/luacheckrc";
  TRY(write_new_file(config, TRY(luacheck_configuration()), Existing::refused));
  const ProgramEnd end = TRY(run_to_end(
      {"luacheck", "--config", config, "--no-cache", "--no-color", "--formatter", "plain", "--codes", "."},
      "which finds unknown names: install the package lua-check", folder));
  if (end.status > luacheck_found_max) return fail("luacheck failed: " + end.output);
  std::vector<FolderFault> faults;
  std::istringstream lines(end.output);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("./"))
      faults.push_back(fault_of_line(std::string_view(line).substr(2)));
    else if (!line.empty())
      faults.push_back(fault_of_line(line));
  return faults;
}

/// The folder's files, but those for editors: "init.lua", "tests/first.lua".
std::vector<std::string> lua_files(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (auto at = fs::recursive_directory_iterator(folder, error); at != fs::recursive_directory_iterator();
       at.increment(error)) {
    if (error) break;
    if (at->is_directory(error) && at->path().filename() == "types") at.disable_recursion_pending();
    if (at->path().extension() == ".lua" && at->is_regular_file(error))
      files.push_back(at->path().lexically_relative(folder).string());
  }
  return files;
}

/// Misspelt fields and methods.
Result<void> add_field_faults(const std::string& folder, const ScratchFolder& scratch,
                              std::vector<FolderFault>& faults) {
  const std::string script = scratch.path() + "/fields.lua";
  TRY(write_new_file(script, field_check_script(), Existing::refused));
  std::vector<std::string> command{"lua5.1", script};
  for (const std::string& file : lua_files(folder)) command.push_back(file);
  const ProgramEnd end =
      TRY(run_to_end(command, "which finds misspelt fields: install the package lua-check", folder));
  if (end.status != 0) return fail("the check of fields failed: " + end.output);
  std::istringstream lines(end.output);
  for (std::string line; std::getline(lines, line);) faults.push_back(fault_of_line(line));
  return {};
}

/// What is wrong as the files load, where that is not said yet.
void add_load_fault(const std::string& folder, std::vector<FolderFault>& faults) {
  const auto loaded = Mod::load({.folder = folder, .name = {}, .told = [](const std::string&, bool) {}});
  if (loaded) return;
  std::string words = loaded.error().message.substr(0, loaded.error().message.find('\n'));
  // "rules NAME: init.lua:3: words"
  const size_t file = words.find(": ");
  const bool has_file = words.starts_with("rules ") && file != std::string::npos;
  const FolderFault fault = fault_of_line(has_file ? words.substr(file + 2) : words);
  const auto is_there = [&](const FolderFault& other) {
    return fault.line != 0 && other.file == fault.file && other.line == fault.line;
  };
  if (std::ranges::none_of(faults, is_there)) faults.push_back(fault);
}

}  // namespace

Result<std::vector<FolderFault>> check_folder(const std::string& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return fail(folder + " is no folder");
  if (!fs::is_regular_file(fs::path(folder) / "init.lua", error))
    return fail(folder + " has no init.lua: scree rules new NAME makes a folder that runs");
  const ScratchFolder scratch;
  if (scratch.path().empty()) return fail("there is no folder for temporary files: set TMPDIR");
  std::vector<FolderFault> faults = TRY(luacheck(folder, scratch));
  TRY(add_field_faults(folder, scratch, faults));
  add_load_fault(folder, faults);
  std::ranges::sort(
      faults, {}, [](const FolderFault& one) { return std::tie(one.file, one.line, one.column, one.words); });
  return faults;
}

}  // namespace scree
