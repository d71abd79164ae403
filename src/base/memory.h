#pragma once
// How much memory the process may still take, so that what cannot succeed is refused before it begins.

#include <string>

namespace pelage {

/// "1.2 GB", in powers of a thousand.
std::string bytes_in_words(double bytes);

/// Of the whole process [bytes], in the place of what the machine has; 0: the machine counts.
void limit_memory(double bytes);

/// Bytes that the process can still take: what is left of its limits (limit_memory, or else those of the system for
/// its address space and data), of its control group and of the machine, whichever is least. Infinite where the system
/// tells nothing. `limit`, if given, becomes what sets the limit, in words: "the machine has 3.1 GB left".
double memory_left(std::string* limit = nullptr);

/// The most that the process had so far [bytes]; 0 where the system does not tell.
double memory_used_at_most();

/// Error(Fault::numerics) where `bytes` more are not left: "WHAT needs about 12 GB of memory, but ...; REMEDY".
void require_memory(double bytes, const std::string& what, const std::string& remedy);

}  // namespace pelage
