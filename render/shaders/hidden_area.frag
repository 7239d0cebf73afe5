// Depth alone. Window space.
void main() {}
