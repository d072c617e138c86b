#include "content/builtin_palette.h"

#include "content/palette_file.h"
#include "shared/base/check.h"

namespace scree {

const Palette& builtin_palette() {
  static const Palette palette = [] {
    const Result<Palette> read = read_palette(builtin_palette_text(), "materials.toml");
    CHECK(read.has_value(), "content/materials.toml has a mistake, which tests/content names");
    return *read;
  }();
  return palette;
}

}  // namespace scree
