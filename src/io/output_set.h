#pragma once
// The files of a command as one: all of them appear, or none.

#include <mutex>
#include <string>
#include <vector>

#include "io/temporary_file.h"

namespace pelage {

/// While one is alive, files that are written (io/atomic_file.h) keep temporary names until publish(), and what is read
/// and written is held against each other. It is ambient, since every writer takes part in it and none has to know:
/// the command line has one around each command, programs that use the library none. Used by several threads at once.
class OutputSet {
 public:
  /// `may_replace_inputs`: whether an output may take the place of a file that was read.
  explicit OutputSet(bool may_replace_inputs = false);
  ~OutputSet();  ///< removes what was not published
  OutputSet(const OutputSet&) = delete;
  OutputSet& operator=(const OutputSet&) = delete;

  /// The one that is alive, or nullptr.
  static OutputSet* current();

  /// The temporary file for that path, which nobody else can have from here on. Error(Fault::usage) where it was
  /// reserved before, or is a file that was read; else the errors of TemporaryFile.
  void reserve(const std::string& path);
  /// For writing: what was reserved, or else is now.
  TemporaryFile take(const std::string& path);
  /// A file that is complete but for its name.
  void keep(TemporaryFile file);
  /// Gives names to all that are kept. May be called again and again, where a command goes on after a part of its work.
  void publish();

 private:
  void read(const std::string& path);
  TemporaryFile reserved(const std::string& path);
  void refuse_input(const std::string& path, const std::string& target) const;

  bool may_replace_inputs_;
  std::mutex mutex_;
  std::vector<std::string> read_;  ///< true paths
  std::vector<TemporaryFile> reserved_, kept_;
  std::vector<std::string> cleared_;  ///< folders
};

/// Of the set that is alive; nothing without one.
void publish_outputs();

}  // namespace pelage
