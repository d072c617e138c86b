// Names of persons, as others see them: each can be seen, and no two alike are there at once. A name says who
// speaks, so nobody may come under a blank one, or under another's.
//
// Names are compared without regard of case, of width and other forms of the same letter, and of all that
// cannot be seen (Unicode's NFKC_Casefold, by utf8proc). Letters of other scripts that look alike are other
// letters.
#pragma once

#include <cstdint>
#include <string>

#include "server/net/session_table.h"
#include "server/net/talk.h"

namespace scree {

/// The name without blanks around it, and with one space for each row of them. Empty, as of who has no name:
/// nothing of it can be seen, or clients show people without a name so (called() in proto/person_name.h).
/// fault_of_text() finds nothing in it.
std::string visible_name(const std::string& said);

/// Equal for names that look alike; empty for an empty name.
std::string name_key(const std::string& name);

/// The name with a number behind it, cut to the limit of names.
std::string numbered_name(const std::string& name, size_t number);

/// Names a session that has just joined, by its grant: a number tells it from somebody who has that name.
/// Whom a token names has the name in any case, and others who came under it get the number; `talk` is told
/// of them.
void name_person(SessionTable& sessions, uint64_t session, Talk& talk);

}  // namespace scree
