// Requests as tables of scripts, both ways: what a script asks for, and what it sees of what persons ask for.
// Rows by kind (request_fields.h) say their fields.
#pragma once

#include <span>
#include <string_view>

#include "server/rules/fields.h"
#include "shared/operation/request.h"

namespace scree {

/// Its name in scripts: "carve". Every request has one.
std::string_view kind_of(const Request& request);
/// By the index of Request.
std::string_view kind_at(size_t index);

/// A request of that kind, which must be one that scripts can write. What a table does not say is as usual;
/// seeds of random numbers follow from the tick and the request's number. The table may say its `kind`, and
/// `by`, which the caller reads.
Result<Request> read_request(std::string_view kind, const ScriptValue& table, const RulesMoment& moment);

/// Writes the fields into the table that is open; none of kinds that scripts do not write (settings,
/// add_piece, …).
void write_request(ScriptWriter& to, const Request& request, const RulesMoment& moment);

/// The request with the fields of the table in place of its own; the rest stays. The table that
/// write_request() filled gives the same request, also with its `kind` and `by`.
Result<Request> changed_request(const Request& before, const ScriptValue& table, const RulesMoment& moment);

/// The fields of each kind that scripts can write, and of the tables in them, for the reference.
std::span<const FieldTable* const> request_field_tables();

/// A number that the tick and the number of the next request give: the same when the world is played again.
uint32_t random_seed_of(const RulesMoment& moment);

}  // namespace scree
