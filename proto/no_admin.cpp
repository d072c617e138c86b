// A page controls replays, and administers nothing else: the other acts, and all lists, are left out of its
// program (proto/admin_codec.h).
#include "proto/admin_codec.h"
#include "proto/limits.h"
#include "proto/playback_codec.h"
#include "shared/base/check.h"
#include "shared/base/text.h"

namespace scree {

void write(wire::Admin& to, const AdminMessage& from) {
  const auto* const control = std::get_if<ControlReplayRequest>(&from.act);
  CHECK(control != nullptr, "a page controls replays alone");
  to.set_request(from.request);
  to.set_token(showable(from.token, limits::token_bytes_max));
  write(*to.mutable_control_replay(), *control);
}

AdminMessage read_admin(const wire::Admin&, FieldChecker& check) {
  check.refuse("a page serves nobody");
  return {};
}

void write(wire::AdminList&, const AdminListMessage&) {
  CHECK(false, "a page answers no administrator");
}

AdminListMessage read_admin_list(const wire::AdminList& from, FieldChecker&) {
  AdminListMessage list;
  list.request = from.request();
  return list;
}

}  // namespace scree
