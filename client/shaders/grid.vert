// One point for each cell of the grid, in blocks of 8³; no buffer holds them.

layout(location = 0) in ivec3 a_block;  // its lowest cell, along each axis

flat out ivec3 v_cell;

void main() {
  v_cell = a_block + ivec3(gl_VertexID >> 6, (gl_VertexID >> 3) & 7, gl_VertexID & 7);
  gl_Position = vec4(0.0);
}
