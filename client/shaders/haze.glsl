// Haze and the fog in which the drawn world ends. Needs clouds.glsl.

uniform vec3 u_eye;
uniform float u_fog_m;  // distance at which fog hides nearly all

vec3 in_fog(vec3 colour, vec3 world, float away) {
  // Thin haze all the way, and the end of what is drawn.
  float haze = 0.45 * (1.0 - exp(-away * (1.0 / 700.0)));
  float fog = 1.0 - (1.0 - haze) * exp(-pow(away / (u_fog_m * 0.80), 4.5));
  vec3 view = (world - u_eye) / max(away, 1e-3);
  vec3 beyond = normalize(vec3(view.x, max(view.y, 0.0), view.z));
  vec3 air = sky(beyond);
  // What the fog hides all but wholly must not stand out before the clouds.
  if (fog > 0.5 && beyond.y > 0.015) air = mix(air, clouded(air, beyond), smoothstep(0.5, 0.95, fog));
  return mix(colour, air, fog);
}
