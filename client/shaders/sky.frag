in vec3 v_direction;
out vec4 o_colour;

void main() {
  vec3 direction = normalize(v_direction);
  vec3 colour = sky(direction);
  float disc = smoothstep(0.99955, 0.9998, dot(direction, u_sun));
  colour += sun_colour * 4.0 * disc;
  if (direction.y > 0.015) colour = clouded(colour, direction);
  o_colour = vec4(tone(colour), 1.0);
}
