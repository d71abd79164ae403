// tinygltf's own code, of which Debian has a library for this machine alone.

#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
