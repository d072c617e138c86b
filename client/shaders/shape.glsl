in vec3 v_rock;
in vec3 v_rock_normal;

// In the frame of the rock. Vertices on an edge have short normals (shared/surface/creases.h), for they belong to several
// faces: beside them the triangle's own is right.
vec3 shape_normal() {
  float whole = length(v_rock_normal);
  vec3 normal = v_rock_normal / max(whole, 1e-3);
  vec3 face = cross(dFdx(v_rock), dFdy(v_rock));
  float size = length(face);
  float sharp = 1.0 - smoothstep(0.80, 0.93, whole);
  if (sharp == 0.0 || size == 0.0) return normal;
  face *= (dot(face, normal) < 0.0 ? -1.0 : 1.0) / size;
  return normalize(mix(normal, face, sharp));
}
