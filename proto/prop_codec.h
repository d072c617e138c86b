// Props and the requests about them, between our types and Protobuf's. Internal to proto/. proto/prop.proto
// specifies them.
#pragma once

#include "proto/wire_values.h"

namespace scree {

void write(wire::Prop& to, const Prop& from);
void write(wire::AddProp& to, const AddPropMessage& from);
void write(wire::RemoveProp& to, const RemovePropMessage& from);
void write(wire::MoveProp& to, const MovePropMessage& from);
void write(wire::Push& to, const PushMessage& from);
void write(wire::Break& to, const BreakMessage& from);
void write(wire::Blast& to, const BlastMessage& from);
void write(wire::CutOut& to, const CutOutMessage& from);
void write(wire::Release& to, const ReleaseMessage& from);
void write(wire::AddPiece& to, const AddPieceMessage& from);
void write(wire::PropHere& to, const PropMessage& from);

/// Kinds that are unknown are noted as such: a request with one is refused.
AddPropMessage read(const wire::AddProp& from, FieldChecker& check);
RemovePropMessage read(const wire::RemoveProp& from, FieldChecker& check);
MovePropMessage read(const wire::MoveProp& from, FieldChecker& check);
PushMessage read(const wire::Push& from, FieldChecker& check);
BreakMessage read(const wire::Break& from, FieldChecker& check);
BlastMessage read(const wire::Blast& from, FieldChecker& check);
CutOutMessage read(const wire::CutOut& from, FieldChecker& check);
ReleaseMessage read(const wire::Release& from, FieldChecker& check);
AddPieceMessage read(const wire::AddPiece& from, FieldChecker& check);
/// Refuses a prop that validate() refuses, or without a mass.
PropMessage read(const wire::PropHere& from, FieldChecker& check);

}  // namespace scree
