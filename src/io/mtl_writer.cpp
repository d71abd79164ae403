#include "io/mtl_writer.h"

#include <utility>

namespace pelage {

std::string mtl_text(const std::string& material, const MtlMaps& maps) {
  std::string text = "newmtl " + material + "\nKd 1 1 1\n";
  for (const auto& [name, statement] : {std::pair{"color", "map_Kd "},
                                        {"normal", "norm "},
                                        {"roughness", "map_Pr "},
                                        {"metalness", "map_Pm "},
                                        {"opacity", "map_d "},
                                        {"emission", "Ke 1 1 1\nmap_Ke "}})
    if (const auto found = maps.find(name); found != maps.end()) text += statement + found->second + "\n";
  return text;
}

}  // namespace pelage
