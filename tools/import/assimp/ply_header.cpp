#include "tools/import/assimp/ply_header.h"

#include <fmt/format.h>
#include <sstream>
#include <string_view>

namespace scree {

namespace {

constexpr std::string_view last_line = "end_header";

/// Bytes of a header in which its end is searched for.
constexpr size_t header_bytes_max = 1 << 20;

/// Where the header's last line begins.
size_t find_last_line(std::string_view file) {
  const std::string_view head = file.substr(0, header_bytes_max);
  for (size_t at = head.find(last_line); at != std::string_view::npos; at = head.find(last_line, at + 1)) {
    const bool begins = at > 0 && (head[at - 1] == '\n' || head[at - 1] == '\r');
    const size_t end = at + last_line.size();
    if (begins && end < file.size() && (file[end] == '\n' || file[end] == '\r')) return at;
  }
  return std::string_view::npos;
}

Result<void> check_promises(std::string_view header, uint64_t bytes) {
  std::istringstream lines{std::string(header)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word, name;
    words >> word;
    if (word == "property" && (!(words >> word >> name) || (word == "list" && !(words >> name >> name))))
      return fail("its header has a property without a type and a name");
    if (word != "element") continue;
    uint64_t count = 0;
    if (!(words >> name)) return fail("its header has an element without a name");
    if (name == "tristrips")
      return fail("its triangles are in strips ('tristrips'), which import does not read: write it as faces");
    if (!(words >> count) || count > bytes)
      return fail(fmt::format("its header promises more '{}' than the file can hold", name));
  }
  return {};
}

}  // namespace

Result<std::string> mended_ply(std::string file) {
  if (!file.starts_with("ply")) return fail("it is no PLY file: it does not begin with 'ply'");
  const size_t at = find_last_line(file);
  if (at == std::string_view::npos) return fail("its header has no end");
  TRY(check_promises(std::string_view(file).substr(0, at), file.size()));
  const size_t end = at + last_line.size();
  if (file[end] == '\n')
    file.insert(end, 1, '\r');
  else if (end + 1 < file.size() && file[end + 1] != '\n')
    file.insert(end + 1, 1, '\n');
  return file;
}

}  // namespace scree
