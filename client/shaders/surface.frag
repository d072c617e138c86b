in vec3 v_world;
in vec3 v_rock;
in vec3 v_normal;
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

void main() {
  float away = length(v_world - u_eye);
  Rock rock = rock_at(v_rock, normalize(v_rock_normal), v_worn, v_look, v_openness, away);
#if SURFACES > 0
  rock.albedo *= 1.0 + u_loose * piece_shade(v_look) * (u_tint - 0.4);
#endif
  vec3 normal = normalize(rotated(u_rotation, rock.normal));
  float sunlight = max(dot(normal, u_sun), 0.0);
  if (sunlight > 0.0) sunlight *= lit(v_world, normalize(v_normal));
  o_colour = vec4(tone(in_fog(lit_rock(rock, normal, v_openness * rock.open, sunlight, (u_eye - v_world) / max(away, 1e-3)), v_world, away)), 1.0);
}
