in vec3 v_world;
in vec3 v_rock;
in vec3 v_normal;
in vec3 v_rock_normal;
in float v_openness;
in float v_before;
flat in int v_paint;

uniform vec4 u_rotation;
uniform float u_loose;  // 1 for a piece, 0 for terrain
uniform float u_tint;   // 0..1, of a piece

out vec4 o_colour;

void main() {
  float away = length(v_world - u_eye);
  Rock rock = rock_at(v_rock, normalize(v_rock_normal), cut_of(v_before), heap_of(v_before), away);
  vec3 albedo = painted(rock.albedo, v_paint, cut_of(v_before)) * (1.0 + u_loose * 0.22 * (u_tint - 0.4));
  vec3 normal = normalize(rotated(u_rotation, rock.normal));
  float sunlight = max(dot(normal, u_sun), 0.0);
  if (sunlight > 0.0) sunlight *= lit(v_world, normalize(v_normal));
  o_colour = vec4(tone(in_fog(lit_rock(albedo, normal, v_openness, sunlight), v_world, away)), 1.0);
}
