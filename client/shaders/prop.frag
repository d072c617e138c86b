in vec3 v_world;
in vec3 v_rock;
in vec3 v_normal;
in vec3 v_rock_normal;
flat in vec4 v_rotation;
flat in float v_tint;
flat in int v_look;

out vec4 o_colour;

void main() {
  float away = length(v_world - u_eye);
  is_whole = true;
  // What is of the ground's bulk looks as a cut lays it bare.
  Rock rock = rock_at(v_rock, normalize(v_rock_normal), vec2(1.0, 0.0), v_look, 1.0, away);
  rock.albedo *= 1.0 + piece_shade(v_look) * (v_tint - 0.4);
  vec3 normal = normalize(rotated(v_rotation, rock.normal));
  float sunlight = max(dot(normal, u_sun), 0.0);
  if (sunlight > 0.0) sunlight *= lit(v_world, normalize(v_normal));
  o_colour = vec4(tone(in_fog(lit_rock(rock, normal, rock.open, sunlight, (u_eye - v_world) / max(away, 1e-3)), v_world, away)), 1.0);
}
