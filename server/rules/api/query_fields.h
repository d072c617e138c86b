// What a question is about, as a table of scripts.
#pragma once

#include "server/rules/fields.h"

namespace scree {

extern const FieldTable mask_fields;  ///< of a QueryMask

}  // namespace scree
