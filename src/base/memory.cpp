#include "base/memory.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "base/number.h"
#include "pelage/error.h"

namespace pelage {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr double kilobyte = 1024;  // of the system's tables

double given_limit = 0;

/// Lines of a small file; none where it is not there.
std::vector<std::string> lines_of(const std::string& path) {
  std::vector<std::string> lines;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "r"), std::fclose);
  if (!file) return lines;
  char line[512];
  while (std::fgets(line, sizeof line, file.get())) lines.emplace_back(line);
  return lines;
}

/// The number in the line that begins so; nothing without one.
std::optional<double> number_in(const std::string& path, std::string_view beginning) {
  for (const std::string& line : lines_of(path)) {
    if (!line.starts_with(beginning)) continue;
    const std::size_t at = line.find_first_not_of(" \t", beginning.size());
    double value = 0;
    if (at == std::string::npos ||
        std::from_chars(line.data() + at, line.data() + line.size(), value).ec != std::errc())
      return {};
    return value;
  }
  return {};
}

double kilobytes_in(const std::string& path, std::string_view beginning) {
  return kilobyte * number_in(path, beginning).value_or(0);
}

struct Limit {
  double left;
  std::string words;  ///< what it is
};

/// Of address space or data, that of a shell's ulimit.
Limit system_limit(std::string_view name, std::string_view used) {
  const std::optional<double> most = number_in("/proc/self/limits", name);
  if (!most) return {unlimited, ""};
  return {*most - kilobytes_in("/proc/self/status", used), "the process may have " + bytes_in_words(*most) + " in all"};
}

/// Of the control group and of those around it, as containers have; only the second version of these groups.
Limit group_limit() {
  std::string folder;
  for (const std::string& line : lines_of("/proc/self/cgroup"))
    if (line.starts_with("0::")) folder = line.substr(3, line.find('\n') - 3);
  double left = unlimited;
  while (!folder.empty() && folder != "/") {
    const std::string path = "/sys/fs/cgroup" + folder;
    if (const auto most = number_in(path + "/memory.max", ""))
      left = std::min(left, *most - number_in(path + "/memory.current", "").value_or(0));
    folder.resize(folder.rfind('/'));
  }
  return {left, "its control group has " + bytes_in_words(std::max(left, 0.0)) + " left"};
}

Limit machine_limit() {
  const std::optional<double> left = number_in("/proc/meminfo", "MemAvailable:");
  if (!left) return {unlimited, ""};
  return {kilobyte * *left, "the machine has " + bytes_in_words(kilobyte * *left) + " left"};
}

Limit least_limit() {
  if (given_limit > 0)
    return {given_limit - kilobytes_in("/proc/self/status", "VmRSS:"),
            "it may take " + bytes_in_words(given_limit) + " in all"};
  Limit least = machine_limit();
  for (Limit other :
       {group_limit(), system_limit("Max address space", "VmSize:"), system_limit("Max data size", "VmData:")})
    if (other.left < least.left) least = std::move(other);
  return least;
}

}  // namespace

std::string bytes_in_words(double bytes) {
  if (bytes < 999.5) return fixed_number(bytes, 0) + " bytes";
  constexpr const char* units[] = {"kB", "MB", "GB", "TB"};
  double value = bytes / 1000;
  std::size_t unit = 0;
  for (; value >= 999.5 && unit < 3; ++unit) value /= 1000;
  return fixed_number(value, value < 9.95 ? 1 : 0) + " " + units[unit];
}

void limit_memory(double bytes) { given_limit = bytes; }

double memory_left(std::string* limit) {
  Limit least = least_limit();
  if (limit) *limit = std::move(least.words);
  return std::max(0.0, least.left);
}

double memory_used_at_most() { return kilobytes_in("/proc/self/status", "VmHWM:"); }

void require_memory(double bytes, const std::string& what, const std::string& remedy) {
  std::string limit;
  if (bytes <= memory_left(&limit)) return;
  throw Error(Fault::numerics,
              what + " needs about " + bytes_in_words(bytes) + " of memory, but " + limit + "; " + remedy);
}

}  // namespace pelage
