// Faces of shadow volumes leave nothing but their mark in the stencil buffer, which the rasteriser makes.
void main() {}
