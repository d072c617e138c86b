// Value noise with its derivative: (value in 0..1, gradient).

float lattice(ivec3 p) {
  uint h = uint(p.x) * 0x8DA6B343u ^ uint(p.y) * 0xD8163841u ^ uint(p.z) * 0xCB1AB31Fu;
  h = (h ^ (h >> 15u)) * 0x2C1B3C6Du;
  h ^= h >> 12u;
  return float(h & 0xFFFFu) / 65535.0;
}

vec4 noise(vec3 p) {
  ivec3 i = ivec3(floor(p));
  vec3 f = p - floor(p);
  vec3 u = f * f * (3.0 - 2.0 * f);
  vec3 du = 6.0 * f * (1.0 - f);
  float a = lattice(i), b = lattice(i + ivec3(1, 0, 0)), c = lattice(i + ivec3(0, 1, 0));
  float d = lattice(i + ivec3(1, 1, 0)), e = lattice(i + ivec3(0, 0, 1)), g = lattice(i + ivec3(1, 0, 1));
  float h = lattice(i + ivec3(0, 1, 1)), k = lattice(i + ivec3(1, 1, 1));
  float k1 = b - a, k2 = c - a, k3 = e - a, k4 = a - b - c + d, k5 = a - c - e + h, k6 = a - b - e + g;
  float k7 = -a + b + c - d + e - g - h + k;
  float value = a + k1 * u.x + k2 * u.y + k3 * u.z + k4 * u.x * u.y + k5 * u.y * u.z + k6 * u.z * u.x +
                k7 * u.x * u.y * u.z;
  vec3 slope = du * vec3(k1 + k4 * u.y + k6 * u.z + k7 * u.y * u.z, k2 + k5 * u.z + k4 * u.x + k7 * u.z * u.x,
                         k3 + k6 * u.x + k5 * u.y + k7 * u.x * u.y);
  return vec4(value, slope);
}

// The same along a line, without the derivative: a fraction of the work.
float noise_1d(float p, int row) {
  int i = int(floor(p));
  float f = p - floor(p);
  return mix(lattice(ivec3(i, row, 0)), lattice(ivec3(i + 1, row, 0)), f * f * (3.0 - 2.0 * f));
}
