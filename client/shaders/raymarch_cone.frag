// For each tile of pixels, how far all of its rays are free: the bits of a float.
uniform float u_cone;   // radius of a tile at one metre
uniform float u_pixel;  // metres a pixel covers at one metre
in vec3 v_direction;
out uint o_along;

void main() { o_along = floatBitsToUint(free_way(normalize(v_direction), u_cone, u_pixel)); }
