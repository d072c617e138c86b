// In place of the built-in palette, whose reader needs libraries that builds of other compilers do without.
// The sessions have a palette of their own (sessions.cpp).
#include "content/builtin_palette.h"

namespace scree {

std::shared_ptr<const Palette> shared_builtin_palette() noexcept {
  return plain_palette();
}

}  // namespace scree
