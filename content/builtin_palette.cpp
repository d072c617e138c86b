#include "content/builtin_palette.h"

#include "content/palette_text.h"
#include "shared/base/check.h"

namespace scree {

std::shared_ptr<const Palette> shared_builtin_palette() noexcept {
  static const std::shared_ptr<const Palette> palette = [] {
    const Result<Palette> read = read_palette(builtin_palette_text(), "materials.toml");
    CHECK(read.has_value(), "content/materials.toml has a mistake, which tests/content names");
    return std::make_shared<const Palette>(*read);
  }();
  return palette;
}

const Palette& builtin_palette() {
  static const std::shared_ptr<const Palette> palette = shared_builtin_palette();
  return *palette;
}

}  // namespace scree
