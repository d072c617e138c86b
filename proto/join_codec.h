// The messages by which a client joins and comes back to and from Protobuf's: Hello, Welcome, Offer, Kept.
// Internal to proto/.
#pragma once

#include "proto/wire_values.h"

namespace scree {

void write(wire::Hello& to, const HelloMessage& from);
void write(wire::Welcome& to, const WelcomeMessage& from);
void write(wire::Offer& to, const OfferMessage& from);
void write(wire::Kept& to, const UnchangedChunksMessage& from);
HelloMessage read_hello(const wire::Hello& from, FieldChecker& check);
WelcomeMessage read_welcome(const wire::Welcome& from, FieldChecker& check);
OfferMessage read_offer(const wire::Offer& from, FieldChecker& check);
UnchangedChunksMessage read_unchanged_chunks(const wire::Kept& from, FieldChecker& check);

}  // namespace scree
