// Messages about elevation models to Protobuf and back. Internal to proto/.
#pragma once

#include "proto/messages.h"
#include "proto/wire_values.h"

namespace scree {

void write(wire::HeightGround& to, const HeightGround& from);
HeightGround read_heights(const wire::HeightGround& from, FieldChecker& check);
void write(wire::GroundRows& to, const GroundRows& from);
void write(wire::RubbleRows& to, const RubbleRows& from);
RubbleRows read_rubble(const wire::RubbleRows& from, FieldChecker& check);
GroundRows read_rows(const wire::GroundRows& from, FieldChecker& check);
void write(wire::TileRequest& to, const AskTilesMessage& from);
AskTilesMessage read_tile_request(const wire::TileRequest& from, FieldChecker& check);
void write(wire::Tile& to, const TileMessage& from);
TileMessage read_tile(const wire::Tile& from, FieldChecker& check);

}  // namespace scree
