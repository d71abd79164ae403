#include "catalog/regions.h"

#include "base/suggest.h"
#include "catalog/embedded.h"
#include "recipe/document.h"

namespace pelage {

std::vector<std::string> region_names() { return embedded_names("regions"); }

namespace {

const EmbeddedFile& region_file(const std::string& name) {
  if (const EmbeddedFile* f = find_embedded("regions", name)) return *f;
  throw Error(Fault::usage, unknown_name("region", name, region_names()));
}

}  // namespace

std::string region_text(const std::string& name) { return std::string(region_file(name).text); }

Region load_region(const std::string& name_or_path) {
  if (name_or_path.ends_with(".toml")) return parse_region(read_text(name_or_path), name_or_path);
  const EmbeddedFile& f = region_file(name_or_path);
  return parse_region(f.text, std::string(f.path));
}

}  // namespace pelage
