#include "server/app/web_folder.h"

#include <filesystem>

#include "shared/base/text.h"

namespace scree {

std::string web_folder_beside_program() {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return {};
  for (const char* place : {"../share/scree/web", "../../web/dist"}) {
    const fs::path folder = (program.parent_path() / place).lexically_normal();
    if (fs::is_regular_file(folder / "index.html", error)) return folder.string();
  }
  return {};
}

std::string page_url(const std::string& bind, uint16_t port, bool tls) {
  const bool everywhere = bind == "0.0.0.0" || bind == "::";
  return (tls ? "https://" : "http://") + endpoint_text(everywhere ? "localhost" : bind, port) + "/";
}

}  // namespace scree
