#pragma once
// Ctrl-C: the first one asks the work to stop, the second one kills.

namespace pelage {

/// From now on SIGINT and SIGTERM only set a flag, once each.
void catch_interrupts();

/// The signal that asked to stop, or 0.
int interrupt_signal();

}  // namespace pelage
