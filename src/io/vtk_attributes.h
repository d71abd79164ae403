#pragma once
// Arrays of VTK XML -> attributes.

#include <functional>
#include <string>
#include <vector>

#include "io/vtk_document.h"
#include "shape/finding.h"

namespace pelage {

/// The array with the bits that say which nodes and cells are hidden.
inline constexpr const char* vtk_ghosts = "vtkGhostType";

class VtkAttributes {
 public:
  /// The values of the array that find(piece) gives, of all pieces one after the other or wherever they belong.
  using Find = std::function<pugi::xml_node(std::size_t piece)>;
  using Join = std::function<std::vector<double>(std::size_t components, const Find& find)>;

  /// All must outlive this.
  VtkAttributes(const VtkDocument& document, const std::vector<pugi::xml_node>& pieces, std::vector<Finding>& findings)
      : document_(document), pieces_(pieces), findings_(findings) {}

  /// The arrays of a section ("PointData") of the pieces, but for vtk_ghosts: RGB and RGBA (sRGB) are "color", Normals
  /// "normal", TextureCoordinates "uv". Findings: what are no numbers, names that are there twice, 64 bit integers that
  /// doubles cannot hold.
  std::vector<Attribute> read(const char* section, Domain domain, const Join& join) const;

  /// The field data beside the data set or, where they were its own, inside of it: labels of these attributes, and the
  /// unit; take(array, name) says whether it took another. What nobody takes is a finding.
  void read_field_data(pugi::xml_node data, std::vector<Attribute>& attributes, std::optional<double>& metres_per_unit,
                       const std::function<bool(pugi::xml_node array, const std::string& name)>& take) const;

 private:
  void note(const std::string& kind, const std::string& text) const { findings_.push_back({kind, text, 1, 0, false}); }
  Attribute read_one(pugi::xml_node first, const std::string& name, const char* section, Domain domain,
                     const Join& join) const;
  void add(Attribute a, pugi::xml_node array, std::vector<Attribute>& attributes) const;
  void narrow(Attribute& a) const;
  bool take_common(pugi::xml_node array, const std::string& name, std::vector<Attribute>& attributes,
                   std::optional<double>& metres_per_unit) const;

  const VtkDocument& document_;
  const std::vector<pugi::xml_node>& pieces_;
  std::vector<Finding>& findings_;
};

}  // namespace pelage
