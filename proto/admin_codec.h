// The messages of administrators: Admin and AdminList. Internal to proto/.
#pragma once

#include "proto/wire_values.h"

namespace scree {

void write(wire::Admin& to, const AdminMessage& from);
AdminMessage read_admin(const wire::Admin& from, FieldChecker& check);

void write(wire::AdminList& to, const AdminListMessage& from);
AdminListMessage read_admin_list(const wire::AdminList& from, FieldChecker& check);

}  // namespace scree
