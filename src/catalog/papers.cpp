#include "catalog/papers.h"

#include "catalog/embedded.h"

namespace pelage {

std::vector<Paper> papers() {
  std::vector<Paper> result;
  for (const std::string& name : embedded_names("figures")) {
    const EmbeddedFile& file = *find_embedded("figures", name);
    result.push_back(parse_paper(std::string(file.text), std::string(file.path), name));
  }
  return result;
}

}  // namespace pelage
