// Sun, sky and haze, shared by everything that is drawn. Colours are linear; tone() makes them fit for the screen.

uniform vec3 u_sun;  // unit, towards the sun

const vec3 sun_colour = vec3(1.0, 0.83, 0.60) * 2.55;
const vec3 zenith_colour = vec3(0.055, 0.155, 0.42);
const vec3 horizon_colour = vec3(0.47, 0.56, 0.65);
const vec3 ground_colour = vec3(0.20, 0.145, 0.10);

vec3 sky(vec3 direction) {
  float up = clamp(direction.y, -0.05, 1.0);
  vec3 colour = mix(horizon_colour, zenith_colour, 1.0 - exp(-3.2 * max(up, 0.0)));
  float towards_sun = max(dot(direction, u_sun), 0.0);
  colour += vec3(1.0, 0.72, 0.42) * (0.22 * pow(towards_sun, 6.0) + 0.35 * pow(towards_sun, 60.0));
  return colour;
}

// Light from the whole sky on a surface: bluish from above, and from below what the sunlit rock gives back.
vec3 ambient(vec3 normal) {
  float up = normal.y * 0.5 + 0.5;
  vec3 below = ground_colour * (0.42 + 0.22 * max(u_sun.y, 0.0) * dot(sun_colour, vec3(0.33)));
  return mix(below, mix(horizon_colour, zenith_colour, 0.5) * 0.80, up);
}

#ifndef AT_CORNERS  // fragments have a place in the picture

// ACES curve as fitted by Narkowicz (2016), then gamma. What 8 bits cannot tell is dithered (interleaved gradient noise,
// Jimenez 2014), so that the sky and soft shadows have no steps.
vec3 tone(vec3 colour) {
  vec3 x = colour * 0.58;
  vec3 mapped = clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
  float dither = fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715)))) - 0.5;
  return pow(mapped, vec3(1.0 / 2.2)) + dither / 255.0;
}

#endif
