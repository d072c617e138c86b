// What a client learns of kept pieces, which never become terrain until they are released (proto/prop.proto).
#pragma once

#include <vector>

#include "shared/base/ids.h"

namespace scree {

/// Pieces that the client has; each list is ordered.
struct KeptPiecesMessage {
  std::vector<PieceId> kept;      ///< that it did not know to be kept
  std::vector<PieceId> released;  ///< that are kept no more

  bool empty() const { return kept.empty() && released.empty(); }
};

}  // namespace scree
