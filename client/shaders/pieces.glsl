// What is known of pieces (client/render/pieces/piece_views.h).
uniform highp sampler2D u_pieces;

// n is 0 for a piece's place (metres) and its tint (0..1), 1 for its rotation (a quaternion x, y, z, w). It is 2 for its
// mesh's origin (voxels in the frame of the rock) and half its width (metres). It is 3 for the point of that frame which
// lies at the place (metres).
vec4 of_piece(int piece, int n) { return texelFetch(u_pieces, ivec2((piece & 63) * 4 + n, piece >> 6), 0); }
