// Where programs keep files of a person's, by the XDG base directory specification.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace scree {

/// "scree" in the folder that the variable of the environment names, or in `in_home` of the home folder.
/// Empty when the environment says neither; a path that is not absolute is ignored.
inline std::string xdg_folder(const char* variable, const char* in_home) {
  const auto folder = [](const char* name) {
    const char* value = std::getenv(name);
    return std::filesystem::path(value == nullptr ? "" : value);
  };
  if (const auto base = folder(variable); base.is_absolute()) return (base / "scree").string();
  const std::filesystem::path home = folder("HOME");
  return home.is_absolute() ? (home / in_home / "scree").string() : std::string();
}

}  // namespace scree
