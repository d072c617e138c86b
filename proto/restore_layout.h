// A restore as packed bytes, of an operation (proto/scree.proto, Frame.changes). Internal to proto/.
#pragma once

#include "proto/byte_stream.h"
#include "shared/operation/operation.h"

namespace scree {

void write_restore(ByteWriter& writer, const RestoreOperation& restore);
RestoreOperation read_restore(ByteReader& reader);

}  // namespace scree
