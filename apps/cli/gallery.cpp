// pelage gallery: every model or every recipe, grown on shapes.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>

#include "base/job_progress.h"
#include "base/parallel.h"
#include "catalog/bind.h"
#include "catalog/images.h"
#include "catalog/size.h"
#include "command.h"
#include "gallery_page.h"
#include "gallery_subjects.h"
#include "input_unit.h"
#include "interrupt.h"
#include "io/atomic_file.h"
#include "io/output_set.h"
#include "look/caption.h"
#include "parts.h"
#include "pelage/io.h"
#include "progress_bar.h"
#include "text.h"
#include "tile_picture.h"
#include "usage.h"
#include "view_options.h"

namespace pelage {

namespace {

constexpr int narrowest_picture = 64, widest_picture = 4096;

struct GalleryOptions {
  std::string folder;
  std::optional<std::string> size;
  std::optional<double> input_unit;  ///< of the shapes, metres
  std::vector<std::string> names, shapes;
  bool recipes = false;
  int picture_size = 512, threads = 0;
  ViewOptions view;
  bool json = false, quiet = false;
};

/// Of a file's path only its name.
std::string short_name(const GallerySubject& subject) {
  std::string name = std::filesystem::path(subject.name).filename().string();
  if (const std::size_t extension = name.find(".toml"); extension != std::string::npos) name.erase(extension, 5);
  return name;
}

/// "gray-scott-spots-sphere.png".
std::string file_name(const GallerySubject& subject, const std::string& shape) {
  std::string name = short_name(subject);
  for (char& c : name)
    if (c == ':' || c == '/' || c == ' ') c = '-';
  return name + "-" + shape + ".png";
}

/// A picture to be made, and where what came of it is noted.
struct Job {
  const GallerySubject* subject;
  const GalleryShape* shape;
  GalleryPicture* picture;
};

Program program_of(const Recipe& recipe, const GalleryShape& shape) {
  ShapeFile file = shape.file;
  return bind_plan(plan(recipe), file, read_images(recipe.textures));
}

std::vector<const Recipe*> recipes_of(const std::vector<GallerySubject>& subjects) {
  std::vector<const Recipe*> recipes;
  for (const GallerySubject& subject : subjects) recipes.push_back(&subject.recipe);
  return recipes;
}

void do_job(const Job& job, const GalleryOptions& options, Journal& journal,
            const std::function<bool(double)>& report) {
  const std::string path = (std::filesystem::path(options.folder) / job.picture->file).string();
  try {
    if (const auto uniform = kept_picture(journal, job.picture->file, path)) {
      job.picture->made = true;
      job.picture->uniform = *uniform;
      return;
    }
    const TilePicture tile =
        tile_picture(job.subject->recipe, job.shape->file, options.view, options.picture_size, report);
    if (tile.image.rgb.empty()) return;
    job.picture->uniform = tile.uniform;
    write_png(with_caption(tile.image, short_name(*job.subject) + ", " + job.shape->name, job.subject->title), path);
    publish_outputs();
    keep_picture(journal, job.picture->file, path, tile.uniform);
    job.picture->made = true;
  } catch (const Error& error) {
    if (error.fault() == Fault::output) throw;
    if (error.fault() == Fault::cancelled) return;
    job.picture->failure = one_line(error.what());
  }
}

std::vector<GalleryEntry> empty_entries(const std::vector<GallerySubject>& subjects,
                                        const std::vector<GalleryShape>& shapes) {
  std::vector<GalleryEntry> entries;
  for (const GallerySubject& subject : subjects) {
    entries.push_back({subject.name, subject.title, subject.summary, subject.cite, {}});
    for (const GalleryShape& s : shapes)
      entries.back().pictures.push_back(
          {file_name(subject, s.name), subject.name + " on the " + s.name, "", "", false});
  }
  return entries;
}

void require_distinct_files(const std::vector<GalleryEntry>& entries) {
  std::set<std::string> files;
  for (const GalleryEntry& entry : entries)
    for (const GalleryPicture& picture : entry.pictures)
      if (!files.insert(picture.file).second)
        throw Error(Fault::usage, "two pictures would be called " + picture.file +
                                      "; the shapes and the names need file names of their own");
}

void warn(const std::string& text) { std::fprintf(stderr, "pelage: warning: %s\n", one_line(text).c_str()); }

void warn_of_valences(const std::vector<GalleryShape>& shapes) {
  for (const GalleryShape& shape : shapes)
    for (const std::string& text : program_of({}, shape).warnings) warn(shape.name + ": " + text);
}

void warn_of_uniform_pictures(const std::vector<Job>& jobs) {
  for (const Job& job : jobs)
    if (!job.picture->uniform.empty()) warn(job.picture->caption + " is uniform, " + job.picture->uniform);
}

std::vector<Job> jobs_for(const std::vector<GallerySubject>& subjects, const std::vector<GalleryShape>& shapes,
                          std::vector<GalleryEntry>& entries) {
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < subjects.size(); ++i)
    for (std::size_t s = 0; s < shapes.size(); ++s) jobs.push_back({&subjects[i], &shapes[s], &entries[i].pictures[s]});
  return jobs;
}

/// False when it was interrupted.
bool make_pictures(const std::vector<Job>& jobs, const GalleryOptions& options, Journal& journal,
                   const Progress& progress) {
  JobProgress job_progress(progress, "making the pictures", jobs.size());
  parallel_chunks(jobs.size(), [&](std::size_t j) {
    const auto report = [&](double fraction) { return job_progress.report(j, fraction); };
    if (!report(0)) return;
    run_on_one_thread([&] { do_job(jobs[j], options, journal, report); });
    report(1);
  });
  return !job_progress.cancelled();
}

/// The page then shows what was finished, and names the rest.
[[noreturn]] void interrupted(const std::vector<Job>& jobs, const std::string& index, const Journal& journal,
                              const std::function<void()>& write_index) {
  std::size_t made = 0;
  for (const Job& job : jobs) {
    made += job.picture->made;
    if (!job.picture->made && job.picture->failure.empty()) job.picture->failure = "interrupted before it was made";
  }
  if (made == 0) throw Error(Fault::cancelled, "interrupted; no picture was finished");
  write_index();
  throw Error(Fault::cancelled, "interrupted; " + index + " shows the " + std::to_string(made) + " of " +
                                    std::to_string(jobs.size()) + " pictures that were finished" +
                                    where_to_go_on(journal, jobs.size(), "pictures"));
}

/// Lengths that a shape cannot give are refused before any work.
void require_lengths(const std::vector<GallerySubject>& subjects, const std::vector<GalleryShape>& shapes) {
  for (const GalleryShape& shape : shapes)
    for (const GallerySubject& subject : subjects)
      for (const Stage& stage : subject.recipe.stages)
        for (const auto& length : {stage.size, stage.unit, stage.points})
          if (length) world_length(*length, scale_of(shape.file));
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

Json to_json(const std::vector<Job>& jobs, bool recipes, const std::string& index) {
  Json pictures = Json::array();
  for (const Job& job : jobs)
    pictures.push_back({{recipes ? "recipe" : "model", job.subject->name},
                        {"shape", job.shape->name},
                        {"file", job.picture->file},
                        {"uniform", !job.picture->uniform.empty()},
                        {"failure", job.picture->failure.empty() ? Json(nullptr) : Json(job.picture->failure)}});
  return {{"index", index}, {"pictures", pictures}};
}

std::vector<GallerySubject> wanted_subjects(const GalleryOptions& options) {
  if (!options.recipes) return model_subjects(options.names, parse_length(options.size.value_or("0.08"), {}));
  if (options.size) throw Error(Fault::usage, "--size is for models; recipes have sizes of their own");
  return recipe_subjects(options.names);
}

void gallery(const GalleryOptions& options) {
  const std::vector<GallerySubject> subjects = wanted_subjects(options);
  const std::vector<GalleryShape> shapes = gallery_shapes(options.shapes, options.recipes, options.input_unit);
  require_lengths(subjects, shapes);
  std::vector<GalleryEntry> entries = empty_entries(subjects, shapes);
  require_distinct_files(entries);
  const std::string index = page_in(options.folder);
  warn_of_valences(shapes);
  catch_interrupts();
  const ThreadLimit threads(options.threads);
  ProgressBar bar(options.quiet ? ProgressBar::Style::none : ProgressBar::style_of_stderr());
  const std::vector<Job> jobs = jobs_for(subjects, shapes, entries);
  const auto write_index = [&] {
    write_file(index, gallery_page(options.recipes ? "Recipes" : "Models", entries, options.picture_size));
    publish_outputs();
  };
  Journal journal(index, record_with_images(recipes_of(subjects)));
  if (!make_pictures(jobs, options, journal, bar.progress())) interrupted(jobs, index, journal, write_index);
  write_index();
  journal.finish();
  bar.clear();
  warn_of_uniform_pictures(jobs);
  report_failures(jobs, options.folder);
  if (options.json)
    print_json(to_json(jobs, options.recipes, index));
  else if (!options.quiet)
    std::printf("wrote     %s and %zu pictures\n", index.c_str(), jobs.size());
}

void add_options(CLI::App& app, GalleryOptions& o) {
  app.add_option(
         "NAME", o.names,
         "Models, MODEL:VARIANT, or .toml files, each with its variants; with --recipes, recipes (default: all)")
      ->type_name("");
  app.add_flag("--recipes", o.recipes, "Recipes instead of models");
  app.add_option("-o,--output", o.folder, "Folder for the pictures and index.html; it is made if need be")
      ->type_name("FOLDER")
      ->required();
  app.add_option("--shape", o.shapes,
                 "What they grow on: a file or builtin:NAME; may be given several times (default: the animal, and a "
                 "sphere for models or a torus for recipes)")
      ->type_name("SHAPE")
      ->allow_extra_args(false);
  app.add_option("--size", o.size, "Spacing of the patterns of models, as in grow (default: 0.08)")
      ->type_name("LENGTH");
  add_input_unit_option(app, o.input_unit);
  app.add_option("--picture-size", o.picture_size, "Width of the pictures, pixels (default: 512)")
      ->type_name("N")
      ->check(whole_number(narrowest_picture, widest_picture));
  add_view_options(app, o.view);
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
      "Make a page with a picture of every model or recipe\n"
      "Every model and variant, or every recipe, grows on each of the shapes; index.html shows all pictures. It needs "
      "no network and can be moved with its folder.");
  add_options(*app, *options);
  app->footer(
      "Examples:\n  pelage gallery -o gallery\n  pelage gallery -o mine turing gray-scott:spots own.toml\n"
      "  pelage gallery -o coats --recipes --shape cow.obj leopard zebra");
  return {app, [options] { gallery(*options); }};
}

}  // namespace pelage
