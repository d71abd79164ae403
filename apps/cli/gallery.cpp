// pelage gallery: every model on a sphere and on the animal.

#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/job_progress.h"
#include "base/parallel.h"
#include "catalog/models.h"
#include "catalog/resolve.h"
#include "command.h"
#include "gallery_page.h"
#include "interrupt.h"
#include "io/atomic_file.h"
#include "io/png_writer.h"
#include "look/caption.h"
#include "look/dress.h"
#include "look/picture.h"
#include "progress_bar.h"
#include "run/run.h"
#include "shape/generators.h"
#include "text.h"
#include "usage.h"

namespace pelage {

namespace {

/// Shapes coarse enough that the pattern alone decides how fine the mesh gets.
struct GalleryShape {
  const char* name;
  const char* spec;
};
constexpr GalleryShape shapes[] = {{"sphere", "builtin:sphere?n=642"}, {"animal", "builtin:animal?n=3000"}};

constexpr int most_threads = 1024;
constexpr int smallest_picture = 64, largest_picture = 4096;
constexpr std::int64_t steps_per_slice = 20;
/// Share of a picture's time that its run takes, the rest being drawing.
constexpr double share_of_run = 0.9;

struct GalleryOptions {
  std::string folder, size = "0.08";
  std::vector<std::string> models;
  int picture_size = 512, threads = 0;
  bool json = false, quiet = false;
};

bool names_variant(const std::string& name) { return !name.ends_with(".toml") && name.find(':') != std::string::npos; }

/// The models that were asked for, each with its variants; all when none was.
std::vector<ModelEntry> wanted_models(const std::vector<std::string>& names) {
  if (names.empty()) return model_list();
  std::vector<ModelEntry> list;
  for (const std::string& name : names) {
    list.push_back({name, load_model(name)});
    if (names_variant(name)) continue;
    const ModelSource source = list.back().source;
    for (const VariantSource& v : source.variants) list.push_back({name + ":" + v.name, with_variant(source, v.name)});
  }
  for (const ModelEntry& entry : list) compile(entry.source);  // faults of files are said before any work
  return list;
}

/// "gray-scott-spots-sphere.png"; of a file's path only its name.
std::string file_name(const std::string& model, const std::string& shape) {
  std::string name = std::filesystem::path(model).filename().string();
  if (const std::size_t extension = name.find(".toml"); extension != std::string::npos) name.erase(extension, 5);
  for (char& c : name)
    if (c == ':' || c == '/' || c == ' ') c = '-';
  return name + "-" + shape + ".png";
}

Recipe recipe_of(const std::string& model, const std::string& size) {
  Recipe recipe;
  recipe.stages[0].model.value = model;
  recipe.stages[0].size = {parse_length(size, {}), {}};
  return recipe;
}

/// One model on one shape; an empty image when `report` asks to stop.
Image make_picture(const Recipe& recipe, const TriangleMesh& shape, int size,
                   const std::function<bool(double)>& report) {
  Run run(resolve(recipe, shape));
  while (!run.done()) {
    if (!report(share_of_run * run.fraction())) return {};
    run.advance(steps_per_slice);
  }
  if (run.summary().status == RunStatus::failed) throw Error(Fault::numerics, run.summary().message);
  PictureOptions options;
  options.width = options.height = size;
  return render(dress(run.fields(), recipe.look), options);
}

/// A picture to be made, and where what came of it is noted.
struct Job {
  const ModelEntry* model;
  const GalleryShape* shape;
  GalleryPicture* picture;
};

void do_job(const Job& job, const TriangleMesh& shape, const GalleryOptions& options,
            const std::function<bool(double)>& report) {
  try {
    const Image image = make_picture(recipe_of(job.model->name, options.size), shape, options.picture_size, report);
    if (image.rgb.empty()) return;
    write_png(with_caption(image, job.model->name + ", " + job.shape->name, job.model->source.title),
              (std::filesystem::path(options.folder) / job.picture->file).string());
    report(1);
  } catch (const Error& error) {
    if (error.fault() == Fault::output) throw;
    job.picture->failure = one_line(error.what());
  }
}

std::vector<GalleryEntry> empty_entries(const std::vector<ModelEntry>& models) {
  std::vector<GalleryEntry> entries;
  for (const ModelEntry& m : models) {
    const bool variant = names_variant(m.name);
    entries.push_back({m.name, m.source.title, variant ? "" : m.source.summary, variant ? "" : m.source.cite, {}});
    for (const GalleryShape& s : shapes)
      entries.back().pictures.push_back({file_name(m.name, s.name), m.name + " on the " + s.name, ""});
  }
  return entries;
}

std::vector<Job> jobs_for(const std::vector<ModelEntry>& models, std::vector<GalleryEntry>& entries) {
  std::vector<Job> jobs;
  for (std::size_t m = 0; m < models.size(); ++m)
    for (std::size_t s = 0; s < std::size(shapes); ++s)
      jobs.push_back({&models[m], &shapes[s], &entries[m].pictures[s]});
  return jobs;
}

void make_pictures(const std::vector<Job>& jobs, const GalleryOptions& options, const Progress& progress) {
  std::vector<TriangleMesh> meshes;
  for (const GalleryShape& s : shapes) meshes.push_back(builtin_shape(s.spec));
  JobProgress job_progress(progress, "making the pictures", jobs.size());
  parallel_chunks(jobs.size(), [&](std::size_t j) {
    const auto report = [&](double fraction) { return job_progress.report(j, fraction); };
    if (!report(0)) return;
    const TriangleMesh& mesh = meshes[static_cast<std::size_t>(jobs[j].shape - shapes)];
    run_on_one_thread([&] { do_job(jobs[j], mesh, options, report); });
  });
  if (job_progress.cancelled())
    throw Error(Fault::cancelled, "interrupted; the pictures that were finished are in " + options.folder +
                                      ", the index was not written");
}

void make_folder(const std::string& folder) {
  std::error_code reason;
  std::filesystem::create_directories(folder, reason);
  if (reason) throw Error(Fault::output, "the folder cannot be made: " + reason.message(), {folder});
  check_folder((std::filesystem::path(folder) / "index.html").string());
}

/// "2 of 12 pictures failed: ..." for the first of them.
void report_failures(const std::vector<Job>& jobs, const std::string& folder) {
  const Job* first = nullptr;
  std::size_t count = 0;
  for (const Job& job : jobs)
    if (!job.picture->failure.empty() && ++count == 1) first = &job;
  if (count == 0) return;
  throw Error(Fault::numerics, std::to_string(count) + " of " + std::to_string(jobs.size()) +
                                   " pictures failed, the first: " + first->picture->caption + ": " +
                                   first->picture->failure + "; the others are in " + folder);
}

Json to_json(const std::vector<Job>& jobs, const std::string& index) {
  Json pictures = Json::array();
  for (const Job& job : jobs)
    pictures.push_back({{"model", job.model->name},
                        {"shape", job.shape->name},
                        {"file", job.picture->file},
                        {"failure", job.picture->failure.empty() ? Json(nullptr) : Json(job.picture->failure)}});
  return {{"index", index}, {"pictures", pictures}};
}

void gallery(const GalleryOptions& options) {
  parse_length(options.size, {});
  const std::vector<ModelEntry> models = wanted_models(options.models);
  make_folder(options.folder);
  catch_interrupts();
  const ThreadLimit threads(options.threads);
  ProgressBar bar(options.quiet ? ProgressBar::Style::none : ProgressBar::style_of_stderr());
  std::vector<GalleryEntry> entries = empty_entries(models);
  const std::vector<Job> jobs = jobs_for(models, entries);
  make_pictures(jobs, options, bar.progress());
  const std::string index = (std::filesystem::path(options.folder) / "index.html").string();
  write_file(index, gallery_page(entries, options.picture_size));
  bar.clear();
  report_failures(jobs, options.folder);
  if (options.json)
    print_json(to_json(jobs, index));
  else if (!options.quiet)
    std::printf("wrote     %s and %zu pictures\n", index.c_str(), jobs.size());
}

void add_options(CLI::App& app, GalleryOptions& o) {
  app.add_option("MODEL", o.models, "Models, MODEL:VARIANT, or .toml files; each with its variants (default: all)")
      ->type_name("");
  app.add_option("-o,--output", o.folder, "Folder for the pictures and index.html; it is made if need be")
      ->type_name("FOLDER")
      ->required();
  app.add_option("--size", o.size, "Spacing of the patterns, as in grow (default: 0.08)")->type_name("LENGTH");
  app.add_option("--picture-size", o.picture_size, "Width of the pictures, pixels (default: 512)")
      ->type_name("N")
      ->check(whole_number(smallest_picture, largest_picture));
  app.add_option("--threads", o.threads, "Threads to use (default: all cores); the result does not depend on it")
      ->type_name("N")
      ->check(whole_number(1, most_threads));
  app.add_flag("--json", o.json, "Print the list of pictures as JSON");
  app.add_flag("-q,--quiet", o.quiet, "Print errors only");
}

}  // namespace

Command add_gallery(CLI::App& parent) {
  auto options = std::make_shared<GalleryOptions>();
  CLI::App* app = parent.add_subcommand(
      "gallery",
      "Make a page with a picture of every model\n"
      "Every model and variant grows on a sphere and on the animal; index.html shows all pictures. It needs no "
      "network and can be moved with its folder.");
  add_options(*app, *options);
  app->footer("Examples:\n  pelage gallery -o gallery\n  pelage gallery -o mine turing gray-scott:spots own.toml");
  return {app, [options] { gallery(*options); }};
}

}  // namespace pelage
