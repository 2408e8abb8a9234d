// Empty fragment shader: faces of shadow volumes only count in the stencil buffer.
void main() {}
