// The programs that shade surfaces, each for what there is to shade: on ground that nobody has touched,
// shaders without materials and rubble cost less. (Mesa's llvmpipe carries out both sides of a branch.) Needs
// the GL context current.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "shared/base/result.h"

namespace scree {

/// What a shader of surfaces knows to draw: the ground, weathered or cut; also materials and rubble; also
/// materials' images.
enum class Surfaces { ground, materials, images };

/// The line that a fragment shader with rock.glsl begins with.
constexpr std::string_view define_of(Surfaces surfaces) {
  switch (surfaces) {
    case Surfaces::ground:
      return "#define SURFACES 0\n";
    case Surfaces::materials:
      return "#define SURFACES 1\n";
    case Surfaces::images:
      break;
  }
  return "#define SURFACES 2\n";
}

template <typename Program>
class SurfaceVariants {
 public:
  using Link = Result<Program> (*)(Surfaces);

  /// Links the first two. The one with images follows when it is first asked for: few worlds have any.
  static Result<SurfaceVariants> make(Link link) {
    SurfaceVariants made(link);
    for (const Surfaces surfaces : {Surfaces::ground, Surfaces::materials}) {
      Result<Program> linked = link(surfaces);
      if (!linked) return fail(linked.error().message);
      made.slot(surfaces).emplace(std::move(*linked));
    }
    return made;
  }
  SurfaceVariants(SurfaceVariants&&) noexcept = default;

  /// The next lesser one where a driver cannot link it.
  const Program& of(Surfaces surfaces) {
    std::optional<Program>& found = slot(surfaces);
    if (!found && !images_fail_) {
      Result<Program> linked = link_(surfaces);
      if (linked) found.emplace(std::move(*linked));
      images_fail_ = !linked;
    }
    return found ? *found : *slot(Surfaces::materials);
  }

 private:
  explicit SurfaceVariants(Link link) : link_(link) {}
  std::optional<Program>& slot(Surfaces surfaces) { return programs_[static_cast<size_t>(surfaces)]; }

  Link link_;
  std::array<std::optional<Program>, 3> programs_;
  bool images_fail_ = false;
};

}  // namespace scree
