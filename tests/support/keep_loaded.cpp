// In sanitizer builds of the program and the GL tests, libraries stay loaded until the process
// ends. Leaks are looked for at the very end: what an unloaded driver still held would be reported
// as lost.
extern "C" int dlclose(void*) { return 0; }
