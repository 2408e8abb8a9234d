// Drawn where the stencil test finds that the surface seen lies in no shadow volume.
layout(location = 0) out float lit_out;

void main() { lit_out = 1.0; }
