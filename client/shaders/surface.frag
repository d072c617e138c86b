in vec3 v_world;
in vec3 v_rock;
in vec3 v_normal;
in vec3 v_rock_normal;
in float v_openness;
in float v_worn;
in vec4 v_paint;
in float v_layer;

uniform vec4 u_rotation;
uniform float u_loose;  // 1 for a piece, 0 for terrain
uniform float u_tint;   // 0..1, of a piece

out vec4 o_colour;

void main() {
  float away = length(v_world - u_eye);
  Rock rock = rock_at(v_rock, normalize(v_rock_normal), v_worn, v_layer, v_paint, v_openness, away);
  vec3 albedo = rock.albedo * (1.0 + u_loose * 0.22 * (u_tint - 0.4));
  vec3 normal = normalize(rotated(u_rotation, rock.normal));
  float sunlight = max(dot(normal, u_sun), 0.0);
  if (sunlight > 0.0) sunlight *= lit(v_world, normalize(v_normal));
  o_colour = vec4(tone(in_fog(lit_rock(albedo, normal, v_openness * rock.open, sunlight), v_world, away)), 1.0);
}
