#pragma once
// Faults of the user: typed exceptions that carry the place of the fault. (Outcomes of numerics are
// returned values, see time/stepper.h; bugs are asserts.)

#include <stdexcept>
#include <string>

namespace pelage {

/// Where a fault lies. Unknown parts stay empty or zero; lines and columns count from 1.
struct Location {
  std::string file;  ///< path as the user gave it, or "" for values from the command line
  int line = 0;
  int column = 0;
};

/// "FILE:LINE:COLUMN", without the parts that are unknown.
std::string to_string(const Location& where);

/// Kinds of fault; the values are the exit codes of the command line.
enum class Fault {
  usage = 2,     ///< wrong option, unknown name or parameter
  input = 3,     ///< a file that cannot be read or a shape that cannot be used
  numerics = 4,  ///< the computation failed: blow-up, not converged
  output = 5,    ///< a file that cannot be written
  cancelled = 130
};

/// what() is "FILE:LINE: what, and what to do", in one line.
class Error : public std::runtime_error {
 public:
  Error(Fault fault, const std::string& message, const Location& where = {});
  Fault fault() const { return fault_; }
  const Location& where() const { return where_; }

 private:
  Fault fault_;
  Location where_;
};

}  // namespace pelage
