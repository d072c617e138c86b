in vec2 v_corner;
flat in vec3 v_albedo;
flat in float v_sunlight;
flat in float v_opacity;
flat in float v_turn;
flat in float v_slender;
in vec3 v_world;

out vec4 o_colour;

void main() {
  float opacity = v_opacity;
  if (v_slender == 0.0) {
    float from_middle = dot(v_corner, v_corner);
    if (from_middle >= 1.0) discard;
    // Billows, whichever this puff has; thin at its rim.
    float billow = noise(vec3(v_corner * 1.9, v_turn * 40.0)).x * 0.65 + noise(vec3(v_corner * 4.3, v_turn * 71.0)).x * 0.35;
    opacity *= (1.0 - from_middle) * smoothstep(0.34, 0.78, billow + 0.25 * (1.0 - from_middle));
  } else if (abs(v_corner.x) + 0.6 * abs(v_corner.y) > 1.0) {
    discard;
  }
  vec3 light = v_albedo * (sun_colour * v_sunlight + ambient(vec3(0.0, 1.0, 0.0)) * 0.8);
  o_colour = vec4(tone(in_fog(light, v_world, length(v_world - u_eye))), opacity);
}
