#pragma once
// Files that appear whole or not at all.

#include <string>
#include <string_view>

#include "io/temporary_file.h"

namespace pelage {

/// Whether a file appears when it is complete, or with the others of its command (io/output_set.h).
enum class Appearance { with_the_others, at_once };

/// A file under construction, under a temporary name (io/temporary_file.h) until commit(). Destruction without commit
/// removes it, so that the final name never shows half a file. All failures are Error(Fault::output) with the path and
/// the reason.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path, Appearance appearance = Appearance::with_the_others);

  void write(std::string_view bytes) { file_.write(bytes); }
  /// For programs that write it themselves.
  const std::string& temporary_name() const { return file_.name(); }
  /// Brings everything to the disk, then renames or leaves that to the set. Nothing may be written afterwards.
  void commit();

 private:
  Appearance appearance_;
  TemporaryFile file_;
};

/// Writes a whole file.
void write_file(const std::string& path, std::string_view bytes, Appearance appearance = Appearance::with_the_others);

/// To be called before the long work whose result goes there: Error(Fault::output) if the folder of `path` does not
/// exist or cannot be written to. Where a set is alive the path is kept for it (OutputSet::reserve), with its errors.
void expect_output(const std::string& path);

}  // namespace pelage
