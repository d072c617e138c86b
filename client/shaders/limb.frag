in vec3 v_world;
in vec3 v_normal;
flat in vec3 v_colour;

out vec4 o_colour;

void main() {
  vec3 to_eye = u_eye - v_world;
  float away = length(to_eye);
  vec3 normal = normalize(v_normal);
  float sunlight = max(dot(normal, u_sun), 0.0);
  if (sunlight > 0.0) sunlight *= lit(v_world, normal);
  Rock cloth = Rock(v_colour, normal, 1.0, 1.0);
  o_colour = vec4(tone(in_fog(lit_rock(cloth, normal, 1.0, sunlight, to_eye / max(away, 1e-3)), v_world, away)), 1.0);
}
