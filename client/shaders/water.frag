// The water's surface, seen from above or from below, over the picture so far: what it mirrors, and how much of what
// lies behind it is lost on the way. Ripples are noise that moves with the wind; the farther away, the flatter.

uniform mat4 u_inverse_view_projection;
uniform highp sampler2D u_depth;
uniform float u_level;  // metres
uniform float u_time;   // seconds

in vec3 v_direction;
out vec4 o_colour;

const vec3 deep_colour = vec3(0.012, 0.050, 0.055);
const vec3 shallow_colour = vec3(0.06, 0.16, 0.14);

vec3 ripples(vec2 place, float away) {
  vec2 slope = noise(vec3(place * 0.55 + vec2(0.35, 0.21) * u_time, u_time * 0.5)).yz * 0.50 +
               noise(vec3(place * 1.9 - vec2(0.22, 0.47) * u_time, u_time * 0.9)).yz * 0.30;
  if (away < 25.0)
    slope += noise(vec3(place * 6.1 + vec2(0.6, -0.3) * u_time, u_time * 1.7)).yz * 0.26 * (1.0 - away / 25.0);
  slope *= 0.14 / (1.0 + away * 0.05);
  return normalize(vec3(-slope.x, 1.0, -slope.y));
}

// Light that reaches the eye through so many metres of water, of 1; red goes first (Pope and Fry 1997, made murky).
float transmitted(float metres) { return exp(-0.42 * metres); }

void main() {
  vec3 direction = normalize(v_direction);
  float depth = texelFetch(u_depth, ivec2(gl_FragCoord.xy), 0).r;
  vec2 size = vec2(textureSize(u_depth, 0));
  vec4 hit = u_inverse_view_projection * vec4(vec3(gl_FragCoord.xy / size, depth) * 2.0 - 1.0, 1.0);
  float seen = depth < 1.0 ? length(hit.xyz / hit.w - u_eye) : 1e9;
  float above = u_eye.y - u_level;
  if (abs(above) < 0.01) above = 0.01;  // an eye in the surface itself sees it from above
  float surface = abs(direction.y) > 1e-4 ? -above / direction.y : -1.0;
  bool crosses = surface > 0.0 && surface < seen;
  if (above < 0.0) {  // the eye is in the water
    float path = min(seen, crosses ? surface : 1e9);
    float lost = 1.0 - transmitted(0.35 * path);
    // Flatter than 49 degrees, the surface mirrors the water beneath (total reflection); above is a window.
    if (crosses) {
      vec3 normal = ripples(u_eye.xz + direction.xz * surface, surface);
      lost = max(lost, 1.0 - 0.85 * smoothstep(0.58, 0.72, dot(direction, normal)));
    }
    o_colour = vec4(tone(mix(shallow_colour, deep_colour, clamp(-above * 0.12, 0.0, 1.0))), lost);
    return;
  }
  if (!crosses) discard;
  vec3 place = u_eye + direction * surface;
  vec3 normal = ripples(place.xz, surface);
  float thickness = min(seen - surface, 60.0);
  float edge = smoothstep(0.0, 0.12, thickness * -direction.y);  // no line where the ground comes out of it
  float facing = clamp(dot(-direction, normal), 0.0, 1.0);
  float mirrors = edge * (0.02 + 0.98 * pow(1.0 - facing, 5.0));  // Schlick 1994
  vec3 bounced = reflect(direction, normal);
  bounced.y = abs(bounced.y);
  vec3 sky_light = sky(bounced);
  if (bounced.y > 0.015) sky_light = clouded(sky_light, bounced);
  sky_light += sun_colour * 6.0 * pow(max(dot(bounced, u_sun), 0.0), 900.0);
  float body = 1.0 - transmitted(thickness);
  vec3 lit = mix(shallow_colour, deep_colour, body) * (0.35 + 0.9 * max(u_sun.y, 0.0));
  float alpha = mirrors + (1.0 - mirrors) * body;
  vec3 colour = (mirrors * sky_light + (1.0 - mirrors) * body * lit) / max(alpha, 1e-3);
  vec3 hazy = in_fog(colour, place, surface);
  float ends = exp(-pow(surface / (u_fog_m * 0.80), 4.5));  // where the fog hides the ground, it hides this
  o_colour = vec4(tone(hazy), max(alpha, 1.0 - ends));
}
