#include "io/mtl_writer.h"

#include <utility>

#include "base/number.h"

namespace pelage {

std::string mtl_text(const std::string& material, const MtlMaps& maps, double emission) {
  const std::string light = number(emission), emits = "Ke " + light + " " + light + " " + light + "\nmap_Ke ";
  std::string text = "newmtl " + material + "\nKd 1 1 1\n";
  for (const auto& [name, statement] : {std::pair<const char*, std::string>{"color", "map_Kd "},
                                        {"normal", "norm "},
                                        {"roughness", "map_Pr "},
                                        {"metalness", "map_Pm "},
                                        {"opacity", "map_d "},
                                        {"emission", emits}})
    if (const auto found = maps.find(name); found != maps.end()) text += statement + found->second + "\n";
  return text;
}

}  // namespace pelage
