#include "film.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "grow_files.h"
#include "grow_run.h"
#include "io/atomic_file.h"
#include "io/file_bytes.h"
#include "io/gltf_animation.h"
#include "io/output_set.h"
#include "io/write_mesh.h"
#include "io/xml_text.h"
#include "look/dress.h"
#include "look/tessellation.h"
#include "node_outputs.h"
#include "picture_files.h"
#include "shape/simplify.h"
#include "text.h"
#include "video.h"

namespace pelage {

namespace {

constexpr double frames_per_second = 25;

/// A run by itself, for the states at any times; linear between steps.
class States {
 public:
  States(std::shared_ptr<const Program> program, const GrowOptions& options, const Progress& progress,
         GrowReport& report)
      : run_(program, World(program, progress), progress) {
    restore(run_, options.resume, report);
    while (!run_.done() && run_.stage() + 1 < program->stages.size()) run_.advance(1);
    time_ = run_.summary().time;
  }

  double begin() const { return time_; }

  /// Later than the one before.
  CoatFields at(double time) {
    while (!run_.done() && run_.summary().time < time) step_towards(time);
    CoatFields now = run_.fields();
    const double t = run_.summary().time;
    if (!before_ || !(time < t)) return now;
    const double share = (time - time_) / (t - time_);
    for (std::size_t i = 0; i < now.coefficients.size(); ++i)
      for (std::size_t j = 0; j < now.coefficients[i].size(); ++j)
        now.coefficients[i][j] = std::lerp(before_->coefficients[i][j], now.coefficients[i][j], share);
    return now;
  }

 private:
  void step_towards(double time) {
    constexpr double room = 1.5;  // steps may become longer
    const RunSummary& s = run_.summary();
    before_.reset();
    time_ = s.time;
    if (s.time + room * s.step >= time) before_ = run_.fields();
    run_.advance(1);
  }

  Run run_;
  double time_ = 0;                   ///< before the last step
  std::optional<CoatFields> before_;  ///< likewise, where it was worth keeping
};

/// Vertices of a coat of fewer triangles, which all frames then have.
class Reduction {
 public:
  Reduction(TriangleMesh coat, std::size_t triangles) {
    Attribute number{name, 1, Domain::vertex, {}};
    for (std::size_t v = 0; v < coat.points.size(); ++v) number.values.push_back(static_cast<double>(v));
    coat.attributes.push_back(std::move(number));
    coat_ = simplify(coat, triangles);
    for (const double v : coat_.find(name)->values) vertices_.push_back(static_cast<std::size_t>(v));
    std::erase_if(coat_.attributes, [](const Attribute& a) { return a.name == name; });
  }

  TriangleMesh of(const TriangleMesh& coat) const {
    TriangleMesh result = coat_;
    for (std::size_t i = 0; i < vertices_.size(); ++i) result.points[i] = coat.points[vertices_[i]];
    for (Attribute& a : result.attributes) {
      const Attribute* from = coat.find(a.name);
      const auto n = static_cast<std::size_t>(a.components);
      for (std::size_t i = 0; from && a.domain == Domain::vertex && i < vertices_.size(); ++i)
        std::copy_n(from->values.begin() + static_cast<std::ptrdiff_t>(n * vertices_[i]), n,
                    a.values.begin() + static_cast<std::ptrdiff_t>(n * i));
    }
    return result;
  }

 private:
  static constexpr const char* name = "vertex of the finer coat";
  TriangleMesh coat_;
  std::vector<std::size_t> vertices_;
};

/// Takes frame after frame.
class FrameWriter {
 public:
  FrameWriter(const GrowOptions& options, const FilmForm& form, bool loop, GrowReport& report)
      : options_(options), form_(form), loop_(loop), report_(report) {
    if (is_video(options.picture)) video_.emplace(options.picture);
  }

  void add(int number, double time, const TriangleMesh& coat, const Progress& progress) {
    times_.push_back(time);
    for (const std::string& path : options_.outputs)
      if (lower_extension(path) == ".glb")
        keep(coat);
      else if (number >= options_.from_frame)
        save(coat, numbered(path, number), form_.mesh);
    if (options_.picture.empty() || (!video_ && number < options_.from_frame)) return;
    const Image image = draw_coat(coat, options_, form_.file, form_.picture, progress);
    if (video_)
      video_->add(image);
    else
      save_picture(image, numbered(options_.picture, number));
  }

  void finish() {
    for (const std::string& path : options_.outputs) {
      if (lower_extension(path) == ".glb") write_animation(path);
      if (lower_extension(path) == ".vtp") write_index(path);
      if (lower_extension(path) != ".glb") tell_sequence(path);
    }
    if (options_.picture.empty()) return;
    if (!video_) return tell_sequence(options_.picture);
    video_->close();
    report_.file(options_.picture, std::to_string(times_.size()) + " frames");
  }

 private:
  void keep(const TriangleMesh& coat) {
    if (!first_) first_ = coat;
    if (frames_.size() < times_.size()) frames_.push_back({coat.points, coat.find("color")->values});
  }

  void tell_sequence(const std::string& path) {
    report_.file(numbered(path, 1), std::to_string(times_.size()) + " frames, the last one " +
                                        numbered(path, static_cast<int>(times_.size())));
  }

  void write_animation(const std::string& path) {
    write_file(path,
               encode_animated_glb(*first_, frames_, 1 / frames_per_second, loop_, {form_.mesh.name, form_.mesh.up}));
    report_.file(path, std::to_string(times_.size()) + " frames, as morph targets of the colours");
  }

  /// What ParaView opens as one.
  void write_index(const std::string& path) {
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
    for (std::size_t k = 0; k < times_.size(); ++k)
      text += "    <DataSet timestep=\"" + exact_number(times_[k]) + "\" part=\"0\" file=\"" +
              escape_xml(std::filesystem::path(numbered(path, static_cast<int>(k) + 1)).filename().string()) + "\"/>\n";
    const std::string index = std::filesystem::path(path).replace_extension(".pvd").string();
    write_file(index, text + "  </Collection>\n</VTKFile>\n");
    report_.file(index, "the times of these files");
  }

  const GrowOptions& options_;
  const FilmForm& form_;
  bool loop_;
  GrowReport& report_;
  std::optional<Video> video_;
  std::vector<double> times_;
  std::optional<TriangleMesh> first_;
  std::vector<AnimationFrame> frames_;
};

std::optional<double> period_of(const GrowOptions& options, const Plan& planned) {
  if (!options.loop) return {};
  const Model& model = planned.stages.back().model;
  if (const auto period = model.period()) return period;
  throw Error(Fault::usage, "--loop needs a pattern that comes back, and the file of the model \"" + model.name() +
                                "\" gives no `period`; forced-brusselator has one");
}

bool is_single_file(const std::string& path) { return lower_extension(path) == ".glb" || is_video(path); }

}  // namespace

Film::Film(const GrowOptions& options, const Plan& planned) : options_(options), period_(period_of(options, planned)) {
  if (wants_images(options) || !options.panels.empty() || !options.plot.empty() || !options.height_map.empty() ||
      !options.patch_images.empty() || options.keep_shape || options.compress || options.print.any() ||
      !options.lines.files.empty())
    throw Error(Fault::usage,
                "--frames makes sequences of -o and --picture; leave --bake, --maps, --panels, --plot, --height-map, "
                "--patch-images, --keep-shape, --compress, --lines, --perforate and --thicken out");
  if (is_video(options.picture)) {
    require_ffmpeg(options.picture);
    expect_output(options.picture);
  }
  if (options.from_frame == 1) return;
  if (std::ranges::any_of(options.outputs, is_single_file) || is_video(options.picture))
    throw Error(Fault::usage, "--from-frame is for frames in files of their own; a video or GLB is made as a whole");
}

void Film::end_with(const Run& run, const Look& look) {
  end_ = run.summary().time;
  if (period_ && end_ < *period_)
    throw Error(Fault::usage, "--loop needs a growth of a whole period, " + number(*period_) +
                                  ", and this one ends at " + number(end_) + "; give a longer --until");
  const CoatFields fields = run.fields();
  const Paint paint = resolve_paint(look, fields.species);
  Tessellation t = tessellate(fields, tessellation_request(look, paint));
  palette_ = make_palette(paint, t.samples, fields.uniform);
  if (options_.triangles) last_ = dress(std::move(t), *palette_);
}

std::vector<double> Film::times(double begin) const {
  const double from = period_ ? end_ - *period_ : begin;
  std::vector<double> times;
  for (int k = 1; k <= *options_.frames; ++k) times.push_back(from + (end_ - from) * k / *options_.frames);
  return times;
}

void Film::shoot(std::shared_ptr<const Program> program, const FilmForm& form, const Progress& progress,
                 GrowReport& report) const {
  States states(std::move(program), options_, progress, report);
  FrameWriter writer(options_, form, period_.has_value(), report);
  std::optional<Reduction> reduction;
  if (last_) reduction.emplace(*last_, static_cast<std::size_t>(*options_.triangles));
  const std::string all = " of " + std::to_string(*options_.frames);
  int number = 0;
  for (const double time : times(states.begin())) {
    const double share = number / static_cast<double>(*options_.frames);
    ++number;
    const auto work = [&] {
      const Progress own = [&](std::string_view, double) {
        return progress("frame " + std::to_string(number) + all, share);
      };
      own("", 0);
      const CoatFields fields = states.at(time);
      const TriangleMesh coat = dress(tessellate(fields, tessellation_request(form.look, palette_->paint)), *palette_);
      writer.add(number, time, reduction ? reduction->of(coat) : coat, own);
      publish_outputs();
    };
    interruptible(
        "at frame " + std::to_string(number) + all + "; with --from-frame " + std::to_string(number) + " it goes on",
        work);
  }
  writer.finish();
}

}  // namespace pelage
