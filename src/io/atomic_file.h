#pragma once
// Files that appear whole or not at all.

#include <cstdio>
#include <string>
#include <string_view>

namespace pelage {

/// A file under construction. The bytes go to a temporary file in the same folder ("NAME.partial"), and
/// commit() gives it its final name, replacing an older file in one step. Destruction without commit
/// removes the temporary file, so that the final name never shows half a file. A symbolic link keeps
/// pointing at the file that is replaced. All failures are Error(Fault::output) with the path and the reason.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);
  /// Brings everything to the disk, then renames. Nothing may be written afterwards.
  void commit();

 private:
  [[noreturn]] void fail(int reason) const;

  std::string path_;       // as the user gave it, for messages
  std::string target_;     // the final name, symbolic links followed
  std::string temporary_;  // "" once committed
  std::FILE* file_ = nullptr;
};

/// Writes a whole file.
void write_file(const std::string& path, std::string_view bytes);

/// Error(Fault::output) if the folder of `path` does not exist or cannot be written to: to be asked before
/// the long work whose result goes there.
void check_folder(const std::string& path);

}  // namespace pelage
