// Lit value, drawn where the stencil test finds the visible surface outside all shadow volumes.
layout(location = 0) out float lit_out;

void main() { lit_out = 1.0; }
