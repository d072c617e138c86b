// Which build runs, and a folder for what it keeps between runs.
#pragma once

#include <string>
#include <utility>

#include "shared/base/result.h"

namespace scree {

/// Names this program: another build has another name.
std::string this_build();

/// A folder of a build's own within one that several builds may use, even at once: it is held by one run at a
/// time. The hold ends with this, or with the process.
class BuildFolder {
 public:
  /// Made if need be. Refused while another run of the same build holds it. All else in `folder` is removed,
  /// for other builds have made it; what another run holds stays.
  static Result<BuildFolder> acquire(const std::string& folder, const std::string& build);
  ~BuildFolder();
  BuildFolder(BuildFolder&& other) noexcept;
  BuildFolder& operator=(BuildFolder&& other) noexcept;

  const std::string& path() const { return path_; }

 private:
  BuildFolder(std::string path, int held) : path_(std::move(path)), held_(held) {}

  std::string path_;
  int held_ = -1;  ///< the folder itself, locked
};

}  // namespace scree
