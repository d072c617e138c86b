// Mass with an origin, as a kept world has it (world.proto, Moment.provenance). Internal to this folder.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "proto/wire_values.h"
#include "server/provenance/provenance.h"

namespace scree {

std::string write_provenance(const std::vector<PlacedMass>& placed);
/// Refuses bytes that are none; what they say is the world's to check.
std::vector<PlacedMass> read_provenance(const std::string& bytes, FieldChecker& check);

}  // namespace scree
