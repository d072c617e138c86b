#include "bench/support/text_file.h"

#include <fstream>
#include <system_error>

namespace scree {

Result<void> write_text_file(const std::filesystem::path& path, const std::string& text) {
  std::error_code told_below;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), told_below);
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out.flush()) return fail("cannot write " + path.string());
  return {};
}

}  // namespace scree
