// The command line: options to library calls, faults to exit codes.

#include <malloc.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <new>
#include <string>
#include <vector>

#include "base/memory.h"
#include "command.h"
#include "interrupt.h"
#include "pelage/error.h"
#include "run_command.h"
#include "text.h"

namespace {

using pelage::Error;
using pelage::Fault;

int report(const std::string& message, int exit_code, bool json) {
  const std::string line = pelage::one_line(message);
  std::fprintf(stderr, "pelage: error: %s\n", line.c_str());
  if (json) pelage::print_json({{"error", line}, {"exit", exit_code}});
  return exit_code;
}

int exit_code_of(Fault fault) {
  const int signal = pelage::interrupt_signal();
  return fault == Fault::cancelled && signal ? 128 + signal : static_cast<int>(fault);
}

std::string out_of_memory() {
  std::string limit;
  pelage::memory_left(&limit);
  const double most = pelage::memory_used_at_most();
  return "out of memory" + (most > 0 ? " at " + pelage::bytes_in_words(most) : "") +
         (limit.empty() ? "" : ": " + limit) +
         "; take a coarser mesh, a larger --size or a smaller --detail or fewer texels";
}

int run(const std::vector<std::string>& words) {
  const bool json = std::ranges::count(words, "--json") > 0;
  int exit_code = 0;
  try {
    exit_code = pelage::run_command(words);
  } catch (const Error& error) {
    return report(error.what(), exit_code_of(error.fault()), json);
  } catch (const std::bad_alloc&) {
    return report(out_of_memory(), static_cast<int>(Fault::numerics), json);
  } catch (const std::exception& error) {
    return report(std::string("unexpected failure: ") + error.what() + "; please report it",
                  static_cast<int>(Fault::numerics), json);
  }
  if (std::fflush(stdout) != 0) return report("cannot write to the standard output", 5, false);
  return exit_code;
}

/// Fields of more than 32 MB would otherwise go back to the system and be asked for again at every step, page by page:
/// on grids of four million nodes that was three quarters of a growth.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int most = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, most);
  mallopt(M_TRIM_THRESHOLD, most);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error of its writer
  return run(std::vector<std::string>(argv + 1, argv + argc));
}
