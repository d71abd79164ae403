#pragma once
// What a long command has finished, kept until it ends, so that the same command goes on where it was cut off.

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace pelage {

/// Finished parts of the work for one output, in a file beside it, `output` + ".pelage-parts": there from the first
/// part on until finish(). A part that was being written when the process died is as if it had never been. Used by
/// several threads at once, but by no other process: who has one has the output to itself (expect_output()).
class Journal {
 public:
  /// Finds what a command with the same `record` (io/output_set.h) has left. Parts of any other command are of no use
  /// and are dropped with the first new one; without a record nothing is found nor kept. Error(Fault::input) where the
  /// file cannot be read.
  Journal(const std::string& output, std::string record);
  ~Journal();  ///< leaves the file
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  const std::string& path() const { return path_; }
  /// The bytes of a part.
  std::optional<std::string> find(const std::string& part) const;
  std::size_t size() const;

  /// Brings a part to the disk. Error(Fault::output).
  void add(const std::string& part, std::string_view bytes);
  /// Removes the file: the output is there.
  void finish();

 private:
  void read();
  void open();
  void append(std::string_view name, std::string_view bytes);

  std::string path_, record_;
  std::map<std::string, std::string> parts_;
  std::size_t sound_ = 0;  ///< bytes of the file that make sense
  int file_ = -1;
  mutable std::mutex mutex_;
};

}  // namespace pelage
