#pragma once
// Files on their way: under a temporary name, locked for as long as they are written.

#include <string>
#include <string_view>

namespace pelage {

inline constexpr std::string_view partial_extension = ".pelage-partial";

/// A file that is going to be `target`, as `target` + ".pelage-partial" in the same folder, so that one renaming puts
/// it in its place. It is locked by this process: two runs cannot write the same file at once, and what a killed run
/// has left, which nobody locks, is taken over. Destruction removes it unless it was put in its place. All failures are
/// Error(Fault::output) with `path`.
class TemporaryFile {
 public:
  /// `path` is what users call it, for messages; a symbolic link keeps pointing at the file that is replaced. What is
  /// no regular file is never replaced.
  explicit TemporaryFile(const std::string& path);
  ~TemporaryFile();
  TemporaryFile(TemporaryFile&& other) noexcept;
  TemporaryFile& operator=(TemporaryFile&& other) noexcept;

  void write(std::string_view bytes);
  /// Brings everything to the disk.
  void sync();
  /// Renames.
  void put_in_place();

  const std::string& path() const { return path_; }
  const std::string& target() const { return target_; }
  const std::string& name() const { return name_; }  ///< the temporary one

 private:
  void drop();

  std::string path_, target_, name_;
  int file_ = -1;
};

/// The file that `path` stands for: symbolic links followed, in one form of several.
std::string true_path(const std::string& path);

[[noreturn]] void fail_to_write(const std::string& path, int reason);

/// Locks an open file for this process, without waiting; whether that was possible.
bool lock_file(int file);

/// Whether the name still stands for the open file.
bool is_at(int file, const std::string& name);

/// Brings the names in a folder to the disk.
void sync_folder(const std::string& folder);

/// Of a file; "" becomes ".".
std::string folder_of(const std::string& path);

}  // namespace pelage
