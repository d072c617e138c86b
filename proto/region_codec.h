// Regions and the requests about them, between our types and Protobuf's. Internal to proto/.
// proto/region.proto specifies them.
#pragma once

#include "proto/wire_values.h"

namespace scree {

void write(wire::SetRegion& to, const SetRegionMessage& from);
void write(wire::RemoveRegion& to, const RemoveRegionMessage& from);
/// At most limits::regions_max.
void write(wire::Regions& to, const RegionsMessage& from);

/// A kind that is unknown is noted as such: a request with one is refused.
SetRegionMessage read(const wire::SetRegion& from, FieldChecker& check);
RemoveRegionMessage read(const wire::RemoveRegion& from, FieldChecker& check);
/// Refuses regions that validate() refuses, and ids or names that come twice.
RegionsMessage read(const wire::Regions& from, FieldChecker& check);

}  // namespace scree
