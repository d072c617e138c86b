// Lists of bodies and joints, between our types and Protobuf's, and which pieces are kept. Internal to
// proto/. proto/access.proto and proto/prop.proto specify them.
#pragma once

#include "proto/wire_values.h"

namespace scree {

void write(wire::ListBodies& to, const ListBodiesRequest& from);
void write(wire::ListJoints& to, const ListJointsRequest& from);
/// Writes the bodies and the joints of a list, and what is left out. At most limits::admin_rows_max of each:
/// the others count as left out, too.
void write_bodies(wire::AdminList& to, const AdminListMessage& from);
/// Each list has at most limits::kept_pieces_max.
void write(wire::KeptPieces& to, const KeptPiecesMessage& from);

ListBodiesRequest read(const wire::ListBodies& from, FieldChecker& check);
ListJointsRequest read(const wire::ListJoints& from, FieldChecker& check);
/// Refuses a joint that validate() refuses.
void read_bodies(const wire::AdminList& from, AdminListMessage& to, FieldChecker& check);
KeptPiecesMessage read(const wire::KeptPieces& from, FieldChecker& check);

}  // namespace scree
