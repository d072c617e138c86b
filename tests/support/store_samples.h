// Messages about stores, one or more of each kind.
#pragma once

#include <vector>

#include "proto/messages.h"
#include "tests/support/materials.h"

namespace scree::samples {

inline std::vector<StoreContent> stores() {
  return {{worlds_store(), {{material::rock, 1LL << 40}, {material::ice, 1}}},
          {{StoreKind::token, 0xFEDCBA9876543210ULL}, {{material::soil, 77}}},
          {{StoreKind::session, 9}, {}},
          {named_store("red"), {{material::rock, 254}}}};
}

inline std::vector<ServerMessage> store_server_messages() {
  const RegionMass mass{{36, 1ULL << 40U}, material::ice, 1LL << 41, 5, 0, 1LL << 40, (1LL << 40) - 12, 7};
  return {StoresMessage{stores()}, AdminListMessage{.request = 5, .left_out = 2, .stores = stores()},
          AdminListMessage{.request = 6, .region_masses = {mass}},
          ReplyMessage{.request = 10, .refusal = {}, .mass = 1LL << 40}};
}

inline std::vector<ClientMessage> store_client_messages() {
  const Shape ball = sphere({4.0F, 5.0F, 6.0F}, 1.5F), slab = box({4.0F, 5.0F, 6.0F}, {1.0F, 2.0F, 1.0F});
  const StoreName token{StoreKind::token, 1ULL << 63U}, session{StoreKind::session, 7};
  return {DigMessage{{ball}, 35},
          DigMessage{{ball, 31, named_store("red")}, 36},
          PlaceMessage{{slab, material::ice, true, worlds_store()}, 37},
          TransferMessage{{{}, worlds_store()}, 38},
          TransferMessage{{session, token, material::soil, 1LL << 40}, 39},
          AdminMessage{18, "", ListStoresRequest{}},
          AdminMessage{19, "", ListRegionMassesRequest{"tower"}}};
}

}  // namespace scree::samples
