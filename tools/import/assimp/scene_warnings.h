// What assimp left out of a mesh, by its own words. Internal to import/assimp.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace scree {

/// Collects assimp's warnings on faces and points while it lives: the first few, none twice. One at a time.
class SceneWarnings {
 public:
  SceneWarnings();
  ~SceneWarnings();
  SceneWarnings(const SceneWarnings&) = delete;
  SceneWarnings& operator=(const SceneWarnings&) = delete;

  const std::vector<std::string>& lines() const { return lines_; }

 private:
  class Stream;

  std::vector<std::string> lines_;
  std::unique_ptr<Stream> stream_;
};

}  // namespace scree
