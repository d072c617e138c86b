in vec3 v_world;
in float v_openness;
in vec2 v_worn;
#if SURFACES > 0
flat in int v_look;
flat in vec4 v_rotation;
flat in float v_tint;
#else
// No piece is drawn so.
const int v_look = 0;
const vec4 v_rotation = vec4(0.0, 0.0, 0.0, 1.0);
#endif

uniform float u_loose;  // 1 for pieces, 0 for terrain

out vec4 o_colour;

void main() {
  float away = length(v_world - u_eye);
  vec3 shape = shape_normal();
  Rock rock = rock_at(v_rock, shape, v_worn, v_look, v_openness, away);
#if SURFACES > 0
  rock.albedo *= 1.0 + u_loose * piece_shade(v_look) * (v_tint - 0.4);
#endif
  vec3 normal = normalize(rotated(v_rotation, rock.normal));
  float sunlight = max(dot(normal, u_sun), 0.0);
  if (sunlight > 0.0) sunlight *= lit(v_world, rotated(v_rotation, shape));
  o_colour = vec4(tone(in_fog(lit_rock(rock, normal, v_openness * rock.open, sunlight, (u_eye - v_world) / max(away, 1e-3)), v_world, away)), 1.0);
}
