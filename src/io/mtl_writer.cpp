#include "io/mtl_writer.h"

namespace pelage {

std::string mtl_text(const std::string& material, const std::string& image) {
  return "newmtl " + material + "\nKd 1 1 1\nmap_Kd " + image + "\n";
}

}  // namespace pelage
