// Clouds in the sky of atmosphere.glsl. Needs noise.glsl.

// Water in the clouds above a place on the plane that they lie in.
float cloud_at(vec2 p) {
  float coarse = noise(vec3(p * 0.45, 11.0)).x;
  float sum = 0.52 * noise(vec3(p, 1.0)).x + 0.26 * noise(vec3(p * 2.1, 2.0)).x + 0.14 * noise(vec3(p * 4.7, 3.0)).x +
              0.08 * noise(vec3(p * 10.3, 4.0)).x;
  return smoothstep(0.50, 0.78, sum + 0.55 * (coarse - 0.5));
}

// Fair-weather clouds on a plane, thin where they turn to haze. A second look towards the sun says how much of it a
// cloud keeps away from this place of its own.
vec3 clouded(vec3 colour, vec3 direction) {
  vec2 p = direction.xz / (direction.y + 0.10) * 1.7;
  float water = cloud_at(p);
  if (water <= 0.0) return colour;
  float shade = cloud_at(p + u_sun.xz * 0.22);
  float towards_sun = max(dot(direction, u_sun), 0.0);
  vec3 lit = vec3(1.02, 0.98, 0.93) * (1.0 + 0.9 * pow(towards_sun, 12.0));
  vec3 cloud = mix(lit, vec3(0.46, 0.50, 0.58), 0.75 * shade);
  return mix(colour, cloud, 0.88 * water * smoothstep(0.015, 0.16, direction.y));
}
