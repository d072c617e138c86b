// A shape within packed bytes (proto/scree.proto, Frame.changes). Internal to proto/.
#pragma once

#include "proto/byte_stream.h"
#include "shared/field/shape.h"

namespace scree {

inline void write_shape(ByteWriter& writer, const Shape& shape) {
  writer.u8(static_cast<uint8_t>(shape.kind));
  writer.vec3(shape.a);
  if (row_of(shape.kind).has_b) writer.vec3(shape.b);
  writer.f32(shape.radius_m);
}

inline Shape read_shape(ByteReader& reader) {
  Shape shape;
  shape.kind = reader.kind<ShapeKind>("kind of shape");
  shape.a = reader.vec3("shape");
  if (traits_of(shape.kind).has_b) shape.b = reader.vec3("shape");
  shape.radius_m = reader.f32("radius of the shape");
  return shape;
}

}  // namespace scree
