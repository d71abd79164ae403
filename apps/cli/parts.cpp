#include "parts.h"

#include <filesystem>
#include <set>

#include "catalog/images.h"
#include "io/atomic_file.h"
#include "io/file_bytes.h"
#include "io/output_set.h"
#include "io/sha256.h"
#include "pelage/error.h"

namespace pelage {

std::string record_with_images(const std::vector<const Recipe*>& recipes) {
  std::set<std::string> seen;
  for (const Recipe* recipe : recipes)
    for (const TextureFile& image : recipe->textures)
      if (seen.insert(image.path).second) read_images({image});
  return record_for_files();
}

std::string where_to_go_on(const Journal& journal, std::size_t all, const std::string& what) {
  if (journal.size() == 0) return "";
  return "; " + std::to_string(journal.size()) + " of " + std::to_string(all) + " " + what + " are kept in " +
         journal.path() + ", and the same command goes on from there";
}

void keep_picture(Journal& journal, const std::string& part, const std::string& path, const std::string& text) {
  journal.add(part, sha256(read_raw_file(path)) + text);
}

std::optional<std::string> kept_picture(const Journal& journal, const std::string& part, const std::string& path) {
  const auto kept = journal.find(part);
  std::error_code ignored;
  if (!kept || !std::filesystem::is_regular_file(path, ignored)) return {};
  const std::string hash = sha256(read_raw_file(path));
  if (!kept->starts_with(hash)) return {};
  return kept->substr(hash.size());
}

std::string page_in(const std::string& folder) {
  std::error_code reason;
  std::filesystem::create_directories(folder, reason);
  if (reason) throw Error(Fault::output, "the folder cannot be made: " + reason.message(), {folder});
  const std::string index = (std::filesystem::path(folder) / "index.html").string();
  expect_output(index);
  return index;
}

}  // namespace pelage
