in vec3 v_world;
in vec3 v_rock;
in vec3 v_rock_normal;
in float v_openness;
in vec2 v_worn;
#if SURFACES > 0
flat in int v_look;
#else
const int v_look = 0;  // no piece is drawn so
#endif

uniform vec4 u_rotation;
uniform float u_loose;  // 1 for a piece, 0 for terrain
uniform float u_tint;   // 0..1, of a piece

out vec4 o_colour;

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

void main() {
  float away = length(v_world - u_eye);
  vec3 shape = shape_normal();
  Rock rock = rock_at(v_rock, shape, v_worn, v_look, v_openness, away);
#if SURFACES > 0
  rock.albedo *= 1.0 + u_loose * piece_shade(v_look) * (u_tint - 0.4);
#endif
  vec3 normal = normalize(rotated(u_rotation, rock.normal));
  float sunlight = max(dot(normal, u_sun), 0.0);
  if (sunlight > 0.0) sunlight *= lit(v_world, rotated(u_rotation, shape));
  o_colour = vec4(tone(in_fog(lit_rock(rock, normal, v_openness * rock.open, sunlight, (u_eye - v_world) / max(away, 1e-3)), v_world, away)), 1.0);
}
