// The files of the game that a Luanti server runs beside ours.
#pragma once

#include <string>

#include "shared/base/result.h"

namespace scree::peers {

inline constexpr const char* luanti_game_id = "scree_peer";

/// Writes the game into that folder, which is made.
Result<void> write_luanti_game(const std::string& folder);

}  // namespace scree::peers
