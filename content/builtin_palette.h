// The palette of worlds that name no file of their own: content/materials.toml, embedded when the program is
// built. Nothing to find at run time.
#pragma once

#include <memory>
#include <string_view>

#include "shared/material/palette.h"

namespace scree {

/// Read once. Any thread.
const Palette& builtin_palette();
std::shared_ptr<const Palette> shared_builtin_palette() noexcept;

/// The file itself, which people copy to begin one of their own.
std::string_view builtin_palette_text();

}  // namespace scree
