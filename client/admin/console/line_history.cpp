#include "client/admin/console/line_history.h"

#include <algorithm>
#include <cctype>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

#include "client/admin/console/limits.h"
#include "shared/base/small_letters.h"
#include "shared/base/xdg_folder.h"

namespace scree {

namespace {

constexpr mode_t of_this_person = S_IRUSR | S_IWUSR;

bool is_kept(std::string_view line) {
  const bool is_text = std::ranges::none_of(line, [](unsigned char c) { return c < ' ' || c == 0x7F; });
  return !line.empty() && line.size() <= limits::typed_line_bytes_max && is_text && !may_hold_secret(line);
}

/// A new folder is this person's alone, as the specification of XDG wants it.
void make_folder(const std::filesystem::path& folder) {
  std::error_code ignored;
  std::filesystem::create_directories(folder.parent_path(), ignored);
  ::mkdir(folder.c_str(), S_IRWXU);
}

/// Writes to a regular file, whose mode becomes that of a new one.
void write_lines(const std::string& path, const std::string& text, int flags) {
  const int file =
      ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | flags, of_this_person);
  if (file < 0) return;
  struct stat there {};
  if (::fstat(file, &there) == 0 && S_ISREG(there.st_mode) && ::fchmod(file, of_this_person) == 0)
      [[maybe_unused]]
    const ssize_t written = ::write(file, text.data(), text.size());
  ::close(file);
}

}  // namespace

std::string admin_history_path() {
  const std::string folder = xdg_folder("XDG_STATE_HOME", ".local/state");
  return folder.empty() ? folder : folder + "/admin_history";
}

bool may_hold_secret(std::string_view line) {
  const std::string lower = in_small_letters(std::string(line));
  return lower.find("token") != std::string::npos || lower.find("scree1.") != std::string::npos;
}

LineHistory::LineHistory(std::string path) : path_(std::move(path)) {
  if (!path_.empty()) read();
}

void LineHistory::read() {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path_, error) ||
      std::filesystem::file_size(path_, error) > limits::typed_file_bytes_max || error) {
    if (std::filesystem::exists(path_, error)) path_.clear();
    return;
  }
  std::ifstream file(path_);
  for (std::string line; std::getline(file, line);)
    if (is_kept(line)) lines_.push_back(line);
  if (lines_.size() > 2 * limits::typed_lines_kept) forget_the_oldest();
}

void LineHistory::forget_the_oldest() {
  lines_.erase(lines_.begin(), lines_.end() - limits::typed_lines_kept);
  std::string text;
  for (const std::string& line : lines_) text += line + '\n';
  write_lines(path_, text, O_TRUNC);
}

bool LineHistory::add(const std::string& line) {
  if (!is_kept(line)) return false;
  if (!lines_.empty() && lines_.back() == line) return true;
  lines_.push_back(line);
  if (path_.empty()) return true;
  make_folder(std::filesystem::path(path_).parent_path());
  write_lines(path_, line + '\n', O_APPEND);
  return true;
}

}  // namespace scree
