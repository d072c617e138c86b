in vec3 v_world;
in vec3 v_normal;
in vec3 v_colour;

out vec4 o_colour;

void main() {
  vec3 to_eye = u_eye - v_world;
  float away = length(to_eye);
  vec3 face = cross(dFdx(v_world), dFdy(v_world));
  if (dot(face, to_eye) < 0.0) face = -face;
  bool is_flat = dot(v_normal, v_normal) < 0.1;
  vec3 normal = normalize(is_flat ? face : gl_FrontFacing ? v_normal : -v_normal);
  float sunlight = max(dot(normal, u_sun), 0.0);
  if (sunlight > 0.0) sunlight *= lit(v_world, normal);
  Rock rock = Rock(v_colour, normal, 1.0, 1.0);
  o_colour = vec4(tone(in_fog(lit_rock(rock, normal, 1.0, sunlight, to_eye / max(away, 1e-3)), v_world, away)), 1.0);
}
