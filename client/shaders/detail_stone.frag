// Stones that lie about: broken rock with flat faces.

in vec3 v_world;
in vec3 v_rock;
flat in vec3 v_tint;
flat in float v_open;
flat in float v_sunlight;

out vec4 o_colour;

void main() {
  vec3 to_eye = u_eye - v_world;
  float away = length(to_eye);
  vec3 face = cross(dFdx(v_world), dFdy(v_world));
  if (dot(face, to_eye) < 0.0) face = -face;
  vec3 normal = normalize(face);
  Rock rock = rock_at(v_rock, normal, vec2(1.0, 0.0), 0, 1.0, away);
  rock.albedo *= v_tint;
  // Little of the sky comes to what is low.
  float open = v_open * mix(0.45, 1.0, smoothstep(-0.6, 0.5, normal.y));
  float sunlight = max(dot(rock.normal, u_sun), 0.0) * v_sunlight;
  o_colour = vec4(tone(in_fog(lit_rock(rock, rock.normal, open * rock.open, sunlight, to_eye / max(away, 1e-3)), v_world, away)), 1.0);
}
