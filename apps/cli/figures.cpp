// pelage figures: the figures of the papers, made again by the commands that stand in figures/.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>

#include "base/suggest.h"
#include "catalog/measured_coat.h"
#include "catalog/papers.h"
#include "command.h"
#include "figures_page.h"
#include "interrupt.h"
#include "io/atomic_file.h"
#include "io/journal.h"
#include "io/output_set.h"
#include "parts.h"
#include "progress_bar.h"
#include "run/run.h"
#include "run_command.h"
#include "text.h"

namespace pelage {

namespace fs = std::filesystem;

namespace {

struct FiguresOptions {
  std::string folder;
  std::vector<std::string> figures;
  bool json = false, quiet = false;
};

/// A panel to be made, and where what came of it is noted.
struct PanelJob {
  std::string figure;  ///< its id
  const FigurePanel* panel;
  MadePanel* made;
};

/// The figures that are asked for, or all.
std::vector<FiguresOfPaper> chosen_figures(const std::vector<Paper>& papers, const std::vector<std::string>& wanted) {
  std::vector<std::string> names;
  for (const Paper& paper : papers) {
    names.push_back(paper.name);
    for (const PaperFigure& figure : paper.figures) names.push_back(figure_id(paper, figure));
  }
  for (const std::string& name : wanted)
    if (std::ranges::find(names, name) == names.end()) throw Error(Fault::usage, unknown_name("figure", name, names));
  const std::set<std::string> set(wanted.begin(), wanted.end());
  std::vector<FiguresOfPaper> chosen;
  for (const Paper& paper : papers) {
    FiguresOfPaper of{&paper, {}, {}};
    for (const PaperFigure& figure : paper.figures) {
      if (!set.empty() && !set.contains(paper.name) && !set.contains(figure_id(paper, figure))) continue;
      of.figures.push_back(&figure);
      of.made.emplace_back(figure.panels.size());
    }
    if (!of.figures.empty()) chosen.push_back(std::move(of));
  }
  return chosen;
}

std::vector<PanelJob> jobs_for(std::vector<FiguresOfPaper>& papers) {
  std::vector<PanelJob> jobs;
  for (FiguresOfPaper& of : papers)
    for (std::size_t k = 0; k < of.figures.size(); ++k)
      for (std::size_t p = 0; p < of.made[k].size(); ++p)
        jobs.push_back({figure_id(*of.paper, *of.figures[k]), &of.figures[k]->panels[p], &of.made[k][p]});
  return jobs;
}

std::string counted(std::size_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

/// What pelage measure finds, in one line.
std::string numbers_of(const FigurePanel& panel) {
  const ShapeFile file = read_shape(*panel.coat, {});
  const PatternMeasures m = measure_coat(file, field_of(file.mesh, *panel.field, *panel.coat), {});
  if (m.maximum - m.minimum < uniform_contrast * std::max(std::abs(m.minimum), std::abs(m.maximum)))
    return "no pattern, " + *panel.field + " is " + brief(m.mean) + " everywhere";
  return *panel.field + " from " + brief(m.minimum) + " to " + brief(m.maximum) + ", wavelength " +
         brief(wavelength_of(m.spectrum.peak())) + ", " + counted(m.above.parts, "part") + " above and " +
         std::to_string(m.below.parts) + " below the middle, " + brief(100 * m.above.share) + " % of the area above" +
         (ground_of(file) == Ground::surface ? ", stripes " + brief(m.coherence) + " of 1" : "");
}

/// In the folder of the page.
void make_panel(const PanelJob& job, Journal& journal) {
  const std::string& picture = job.panel->picture;
  if (const auto numbers = kept_picture(journal, picture, picture)) {
    job.made->numbers = *numbers;
    return;
  }
  try {
    for (const Given<std::string>& command : job.panel->commands) run_quietly(words_of(command.value));
    if (job.panel->coat) job.made->numbers = numbers_of(*job.panel);
    keep_picture(journal, picture, picture, job.made->numbers);
  } catch (const Error& error) {
    if (error.fault() == Fault::output || error.fault() == Fault::cancelled) throw;
    job.made->failure = one_line(error.what());
  }
}

/// Commands are data: a misspelt one is found before the first runs.
void check_commands(const std::vector<Paper>& papers) {
  std::set<std::string> pictures;
  for (const Paper& paper : papers)
    for (const PaperFigure& figure : paper.figures)
      for (const FigurePanel& panel : figure.panels) {
        if (!pictures.insert(panel.picture).second)
          throw Error(Fault::usage, "two panels write " + panel.picture, panel.commands[0].where);
        for (const Given<std::string>& command : panel.commands) try {
            check_command(words_of(command.value));
          } catch (const Error& error) {
            throw Error(Fault::usage, error.what(), command.where);
          }
      }
}

/// In the folder, since the commands name files as one would who types them there.
void make_panels(const std::vector<PanelJob>& jobs, Journal& journal, const Progress& progress) {
  for (std::size_t j = 0; j < jobs.size(); ++j) {
    const double done = static_cast<double>(j) / static_cast<double>(jobs.size());
    try {
      if (!progress("figure " + jobs[j].figure, done)) throw Error(Fault::cancelled, "");
      make_panel(jobs[j], journal);
    } catch (const Error& error) {
      if (error.fault() != Fault::cancelled) throw;
      throw Error(Fault::cancelled, "interrupted" + where_to_go_on(journal, jobs.size(), "pictures"));
    }
  }
}

void report_failures(const std::vector<PanelJob>& jobs, const std::string& index) {
  const PanelJob* first = nullptr;
  std::size_t count = 0;
  for (const PanelJob& job : jobs)
    if (!job.made->failure.empty() && ++count == 1) first = &job;
  if (count > 0)
    throw Error(Fault::numerics, std::to_string(count) + " of " + std::to_string(jobs.size()) +
                                     " pictures failed, the first: " + first->panel->picture + ": " +
                                     first->made->failure + "; the others are in " + index);
}

Json to_json(const std::vector<FiguresOfPaper>& papers) {
  Json figures = Json::array();
  for (const FiguresOfPaper& of : papers)
    for (std::size_t k = 0; k < of.figures.size(); ++k) {
      const PaperFigure& figure = *of.figures[k];
      Json panels = Json::array();
      for (std::size_t p = 0; p < figure.panels.size(); ++p) {
        Json commands = Json::array();
        for (const Given<std::string>& command : figure.panels[p].commands) commands.push_back(command.value);
        panels.push_back({{"caption", figure.panels[p].caption},
                          {"picture", figure.panels[p].picture},
                          {"commands", commands},
                          {"numbers", of.made[k][p].numbers}});
      }
      figures.push_back({{"figure", figure_id(*of.paper, figure)},
                         {"paper", of.paper->title},
                         {"shows", figure.shows},
                         {"verdict", verdict_in_words(figure.verdict)},
                         {"said", figure.said},
                         {"panels", panels}});
    }
  return {{"figures", figures}};
}

void print_list(const std::vector<FiguresOfPaper>& papers) {
  for (const FiguresOfPaper& of : papers) {
    std::printf("%s: %s\n", of.paper->name.c_str(), of.paper->title.c_str());
    for (const PaperFigure* figure : of.figures)
      std::printf("  %-20s %s\n", figure_id(*of.paper, *figure).c_str(), verdict_in_words(figure->verdict).c_str());
  }
}

void figures(const FiguresOptions& options) {
  const std::vector<Paper> all = papers();
  std::vector<FiguresOfPaper> chosen = chosen_figures(all, options.figures);
  if (options.folder.empty()) return options.json ? print_json(to_json(chosen)) : print_list(chosen);
  check_commands(all);
  const std::string index = page_in(fs::absolute(options.folder).string());
  catch_interrupts();
  ProgressBar bar(options.quiet ? ProgressBar::Style::none : ProgressBar::style_of_stderr());
  const std::vector<PanelJob> jobs = jobs_for(chosen);
  Journal journal(index, record_for_files());
  fs::current_path(fs::path(index).parent_path());
  make_panels(jobs, journal, bar.progress());
  write_file(index, figures_page(chosen));
  publish_outputs();
  journal.finish();
  bar.clear();
  report_failures(jobs, index);
  if (options.json)
    print_json(to_json(chosen));
  else if (!options.quiet)
    std::printf("wrote     %s and %zu pictures\n", index.c_str(), jobs.size());
}

}  // namespace

Command add_figures(CLI::App& parent) {
  auto options = std::make_shared<FiguresOptions>();
  CLI::App* app = parent.add_subcommand(
      "figures",
      "Make the figures of the papers again\n"
      "Every figure of the papers that the program follows, by the commands that stand below each picture, with what "
      "the paper shows, what is made otherwise and why, and the numbers of each pattern. Without -o: lists the "
      "figures. Interrupted, the same command goes on where it was.");
  app->add_option("FIGURE", options->figures, "Papers or figures, such as turk or turk-2 (default: all)")
      ->type_name("");
  app->add_option("-o,--output", options->folder,
                  "Folder for index.html, the pictures and the coats; it is made if need be")
      ->type_name("FOLDER");
  app->add_flag("--json", options->json, "Print the list of figures as JSON");
  app->add_flag("-q,--quiet", options->quiet, "Print errors only");
  app->footer("Examples:\n  pelage figures\n  pelage figures -o figures turk-2 bajaj");
  return {app, [options] { figures(*options); }};
}

}  // namespace pelage
