#pragma once
// The files of a command as one: all of them appear, or none.

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/read_files.h"
#include "io/record.h"
#include "io/temporary_file.h"

namespace pelage {

/// Where a command that comes from elsewhere may read and write; empty: everywhere.
struct Confinement {
  std::string read_in, write_in;  ///< folders
};

struct OutputSetOptions {
  bool may_replace_inputs = false;    ///< whether an output may take the place of a file that was read
  Confinement confinement = {};       ///< Error(Fault::usage) for all that lies elsewhere
  std::optional<Record> record = {};  ///< of the command, for its files; what is read while the set is alive is added
};

/// While one is alive, files that are written (io/atomic_file.h) keep temporary names until publish(), and what is read
/// and written is held against each other. It is ambient, since every writer takes part in it and none has to know:
/// the command line has one around each command, programs that use the library none. A second one takes the place of
/// the first while it is alive. Used by several threads at once.
class OutputSet {
 public:
  explicit OutputSet(OutputSetOptions options = {});
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

  /// Adds to the record, instead of what has the same name there.
  void add_value(const std::string& name, const std::string& text);
  void add_text(const std::string& name, const std::string& text);
  /// What is known by now; empty where none is kept.
  std::optional<Record> record();

 private:
  void read(const std::string& path);
  void note_bytes(const std::string& path, std::string_view bytes);
  TemporaryFile reserved(const std::string& path);
  void refuse_input(const std::string& path, const std::string& target) const;

  OutputSetOptions options_;
  std::string folder_;                           ///< of the command
  std::map<std::string, RecordedInput> inputs_;  ///< by the paths under which they were read
  OutputSet* before_;
  ReadObserver observer_before_;
  std::mutex mutex_;
  std::vector<std::string> read_;  ///< true paths
  std::vector<TemporaryFile> reserved_, kept_;
  std::vector<std::string> cleared_;  ///< folders
};

/// Of the set that is alive; nothing without one.
void publish_outputs();
void record_value(const std::string& name, const std::string& text);
void record_source(const std::string& name, const std::string& text);

/// The record that a file should carry (io/record.h), or nothing. Every writer whose format has room asks for it.
std::string record_for_files();

}  // namespace pelage
