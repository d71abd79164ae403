#pragma once
// Progress of long work that one thread does from its beginning to its end.

#include "pelage/error.h"
#include "pelage/progress.h"

namespace pelage {

/// Error(Fault::cancelled) when the caller asks to stop.
inline void report(const Progress& progress, std::string_view what, double fraction) {
  if (progress && !progress(what, fraction)) throw Error(Fault::cancelled, "cancelled");
}

}  // namespace pelage
