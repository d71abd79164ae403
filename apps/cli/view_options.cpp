#include "view_options.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/suggest.h"
#include "look/ramp.h"
#include "shape/front.h"
#include "usage.h"

namespace pelage {

namespace {

struct View {
  double azimuth, elevation;
};

/// From a little above, so that the shape is seen to stand.
const std::map<std::string, View>& views() {
  static const std::map<std::string, View> all = {
      {"front", {0, 8}}, {"side", {90, 8}}, {"top", {0, 80}}, {"three-quarter", {35, 14}}};
  return all;
}

/// What `table` calls so.
template <class Value>
const Value& named(const std::map<std::string, Value>& table, const std::string& option, const std::string& kind,
                   const std::string& name) {
  std::vector<std::string> names;
  for (const auto& [known, value] : table) names.push_back(known);
  const auto found = table.find(name);
  if (found == table.end()) throw CLI::ValidationError(option, unknown_name(kind, name, names));
  return found->second;
}

/// Shapes that look away from the camera are turned to it; others are seen as they lie in the file.
double azimuth_of(const ViewOptions& view, double usual, std::optional<double> front) {
  if (view.from_front) return front.value_or(0) + *view.from_front;
  const bool away = front && std::abs(std::remainder(*front - usual, 360)) > 90;
  return away ? *front + usual : usual;
}

void add_direction_options(CLI::App& app, ViewOptions& o) {
  app.add_option("--azimuth", o.azimuth,
                 "Where the camera stands around the up axis, degrees: 0 before the shape (+z, or -y where z points "
                 "up), 90 at +x (default: 35, or as far from its face where the shape "
                 "would be seen from behind)")
      ->type_name("DEG");
  app.add_option("--elevation", o.elevation, "And above the horizon, -89 to 89 degrees (default: 14)")
      ->type_name("DEG");
}

constexpr double shortest_lens = 11, longest_lens = 2000;  // mm: what a picture's angle may be

void add_camera_options(CLI::App& app, ViewOptions& o) {
  CLI::Option* lens =
      app.add_option("--focal-length", o.lens,
                     "Lens of the camera, mm before 35 mm film: 24 wide, 200 far away; what is seen stays as large "
                     "(default: 78)")
          ->type_name("MM")
          ->check(CLI::Range(shortest_lens, longest_lens));
  CLI::Option* camera = app.add_option("--camera", o.camera,
                                       "Take the camera of a glTF or GLB file, as Blender writes it: its place, lens "
                                       "and proportions; the first one in the scene")
                            ->type_name("FILE");
  camera->excludes(lens);
  for (const char* name : {"--view", "--azimuth", "--elevation"}) camera->excludes(app.get_option(name));
}

/// glTF is in metres and its y axis points up; shapes need not be so.
Point from_gltf(const Point& p, UpAxis up, double metres_per_unit = 1) {
  const Point q = up == UpAxis::y ? p : Point{p[0], -p[2], p[1]};
  return {q[0] / metres_per_unit, q[1] / metres_per_unit, q[2] / metres_per_unit};
}

void take_camera(const GltfCamera& camera, double metres_per_unit, PictureOptions& picture) {
  picture.camera = {from_gltf(camera.position, picture.up, metres_per_unit), from_gltf(camera.towards, picture.up),
                    from_gltf(camera.up, picture.up)};
  const double aspect = camera.aspect.value_or(static_cast<double>(picture.width) / picture.height);
  set_proportions(picture, std::max(picture.width, picture.height), aspect);
  constexpr double radian = std::numbers::pi / 180;
  picture.angle = 2 / radian * std::atan(std::tan(camera.angle / 2 * radian) * std::max(1.0, aspect));
}

}  // namespace

void add_view_options(CLI::App& app, ViewOptions& o, const std::string& group) {
  app.add_option_function<std::string>(
         "--view",
         [&o](const std::string& name) {
           const View& view = named(views(), "--view", "view", name);
           if (name != "three-quarter") o.from_front = view.azimuth;
           if (!o.elevation) o.elevation = view.elevation;
         },
         "From where a picture is taken, seen from the shape's front if it has one: front, side, top or three-quarter "
         "(default)")
      ->type_name("NAME");
  add_direction_options(app, o);
  add_camera_options(app, o);
  app.add_option("--exposure", o.exposure, "Brighter (or, below 0, darker) by so many stops, factors of two")
      ->type_name("STOPS");
  app.add_option_function<std::string>(
         "--background",
         [&o](const std::string& hex) {
           try {
             o.background = parse_hex_color(hex);
           } catch (const Error& error) {
             throw CLI::ValidationError("--background", error.what());
           }
         },
         "Colour of the paper on which the shape stands (default: light grey)")
      ->type_name("#RRGGBB");
  app.add_flag("--no-ground", o.no_ground, "Let the shape stand before the paper, without a shadow on it");
  app.add_option_function<std::string>(
         "--up",
         [&o](const std::string& name) {
           static const std::map<std::string, UpAxis> axes = {{"y", UpAxis::y}, {"z", UpAxis::z}};
           o.up = named(axes, "--up", "axis", name);
         },
         "Which axis of the shape points up, y or z, in pictures and in GLB, which is turned for it (default: what the "
         "file says, otherwise y)")
      ->type_name("AXIS");
  for (const char* name : {"--view", "--azimuth", "--elevation", "--focal-length", "--camera", "--exposure",
                           "--background", "--no-ground", "--up"})
    if (!group.empty()) app.get_option(name)->group(group);
}

void add_turntable_option(CLI::App& app, ViewOptions& o, const std::string& group) {
  CLI::Option* turntable =
      app.add_option("--turntable", o.turntable,
                     "So many pictures around the shape, from where one would be taken: cow.png becomes cow.0001.png "
                     "and so on, .mp4 and .webm a video (by ffmpeg)")
          ->type_name("N")
          ->check(whole_number(2, 100'000))
          ->excludes(app.get_option("--camera"));
  if (!group.empty()) turntable->group(group);
}

void set_proportions(PictureOptions& picture, int longer_side, double aspect) {
  picture.width = std::max(1, static_cast<int>(std::lround(longer_side * std::min(1.0, aspect))));
  picture.height = std::max(1, static_cast<int>(std::lround(longer_side / std::max(1.0, aspect))));
}

PictureOptions picture_options(const ViewOptions& view, int size, UpAxis up, const TriangleMesh& shape) {
  PictureOptions picture;
  picture.width = picture.height = size;
  picture.up = view.up.value_or(up);
  picture.azimuth = view.azimuth ? *view.azimuth : azimuth_of(view, picture.azimuth, front_of(shape, picture.up));
  picture.elevation = view.elevation.value_or(picture.elevation);
  picture.background = view.background.value_or(picture.background);
  picture.exposure = view.exposure;
  picture.ground = !view.no_ground;
  if (view.lens) picture.angle = angle_of_lens(*view.lens);
  if (view.camera) take_camera(read_gltf_camera(*view.camera), shape.metres_per_unit.value_or(1), picture);
  return picture;
}

}  // namespace pelage
