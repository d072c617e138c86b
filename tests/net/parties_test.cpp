// Who is one party with whom.
#include "server/doors/parties.h"

#include <gtest/gtest.h>

#include "server/doors/limits.h"

namespace scree {
namespace {

TEST(Parties, have_the_number_of_their_first_session_and_keep_it_for_a_while) {
  Parties parties;
  EXPECT_EQ(parties.join("here", 1, 0.0), 1U);
  EXPECT_EQ(parties.join("there", 2, 0.0), 2U);
  EXPECT_EQ(parties.join("here", 3, 0.0), 1U);
  parties.leave("here", 1.0);
  parties.leave("here", 1.0);
  EXPECT_EQ(parties.join("here", 4, 1.0 + limits::party_memory_s), 1U) << "by coming again nobody is another";
  parties.leave("here", 20.0);
  EXPECT_EQ(parties.join("here", 5, 20.1 + limits::party_memory_s), 5U);
  EXPECT_EQ(parties.join("there", 6, 1000.0), 2U) << "its session lasts";
}

}  // namespace
}  // namespace scree
