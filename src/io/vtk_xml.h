#pragma once
// What files of VTK XML have in common on the way out. The arrays are uncompressed base64 within the XML text, because
// ParaView 5.11 fails on the appended form.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// The beginning of a file of that kind ("PolyData"), up to and with the element of that name but for its `>`. It ends
/// in vtk_tail.
std::string vtk_head(const std::string& kind);
std::string vtk_tail(const std::string& kind);

/// "Float32", "UInt8", ...: how VTK calls a type.
const char* vtk_name(NumberType type);

/// Values as bytes of that type, which they must be of.
std::string packed(const std::vector<double>& values, NumberType type);

/// A DataArray of bytes. `tuples` where nothing else in the file says their number: field data.
void append_vtk_array(std::string& text, const std::string& type, const std::string& name, int components,
                      const std::string& bytes, std::size_t tuples = 0);

/// How many bits a file has for each channel of a colour.
enum class ColorBits { eight, as_stored };

/// An attribute under the name by which VTK's programs know it: "color" is RGB or RGBA, "normal" Normals and "uv"
/// TextureCoordinates. Colours are sRGB: UInt8, or UInt16 where the attribute is of that type and `bits` as_stored.
void append_vtk_attribute(std::string& text, const Attribute& attribute, ColorBits bits);

/// The tag that opens the point data, which says which arrays are the active ones; three.js needs at least one
/// attribute here.
std::string vtk_point_data_tag(std::span<const Attribute> attributes);

/// What the numbers of materials, groups and objects mean, as field data NAME_labels: arrays of strings, each ended by
/// a 0.
std::string vtk_labels(std::span<const Attribute> attributes);

/// The unit as field data `metres_per_unit`; empty where nothing is known.
std::string vtk_unit(const std::optional<double>& metres_per_unit);

/// The record of the command as a string in field data; empty where there is none.
inline constexpr const char* vtk_record_name = "pelage";
std::string vtk_record();

/// The element Points: Float32 where that changes no number, else Float64.
void append_vtk_points(std::string& text, const std::vector<Point>& points);

/// Standard base64 with padding (RFC 4648, section 4), appended to `text`.
void append_base64(std::string& text, const std::string& bytes);

}  // namespace pelage
