#include "invocation.h"

#include <utility>

namespace pelage {

namespace {

Invocation current;

}  // namespace

const Invocation& invocation() { return current; }

void set_invocation(Invocation now) { current = std::move(now); }

}  // namespace pelage
