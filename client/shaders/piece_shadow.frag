void main() {
  PieceHit hit = march_piece();
  if (!hit.found) discard;
  // Half a voxel behind the surface, so that it does not shade itself.
  gl_FragDepth = depth_of(hit.world - u_viewpoint.xyz * (0.5 / u_voxels_per_m[0]));
}
