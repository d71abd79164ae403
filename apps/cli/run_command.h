#pragma once
// From the words of a command line to what it does.

#include <string>
#include <vector>

#include "io/output_set.h"

namespace pelage {

/// Runs a command; its outputs appear together at its end, or not at all. Returns the exit code.
int run_command(std::vector<std::string> words);

/// The words of a command as it is typed: what stands in quotes is one.
std::vector<std::string> words_of(const std::string& command);
/// Error(Fault::usage) for words that run_command() would refuse, without running it.
void check_command(const std::vector<std::string>& words);
/// run_command() without a word on stdout, in the middle of another command.
void run_quietly(std::vector<std::string> words);

/// The record of a file, which may come from anywhere, made to do its work again.
struct Repetition {
  std::vector<std::string> words;  ///< of the record
  std::string folder, file;        ///< where its outputs go: words_to_repeat()
  Confinement confinement;
  std::string version, architecture;  ///< of the new record
};

/// Runs it, without a word on stdout. Error(Fault::usage) where the words are not those of a command that can be
/// repeated, and where it would read or write elsewhere.
void repeat_command(const Repetition& repetition);

}  // namespace pelage
