#pragma once
// What pelage grow says it did: lines while it goes, or one JSON object at the end.

#include <string>

#include "command.h"
#include "pelage/io.h"
#include "profile.h"
#include "progress_bar.h"
#include "run/forecast.h"
#include "run/run.h"

namespace pelage {

/// What the pattern of a program grows on: the given shape, also where its nodes are cells on it.
std::shared_ptr<const TriangleMesh> shape_of(const Program& program);

class GrowReport {
 public:
  enum class Form { lines, json, nothing };
  GrowReport(Form form, ProgressBar& bar) : form_(form), bar_(bar) {}

  void shape(const std::string& name, const ShapeFile& file);
  /// Of --onto.
  void onto(const std::string& name, const ShapeFile& file);
  void warning(const std::string& text);
  /// Those that the run did not give before.
  void warnings(const Run& run);
  /// What is going to be needed, where that is much.
  void need(const Forecast& forecast, double bytes);
  void pattern(const Run& run);
  /// Warns of a shape whose vertices alone cannot show the pattern.
  void coarseness(const Run& run);
  /// `seconds`: of the whole growth.
  void estimate(const Run& run, double seconds);
  /// That the state is kept on the way.
  void saving(const std::string& path, double minutes);
  void surface(const MovingSurface& surface);
  void growth(const Run& run, double seconds);
  /// What a coat is as a solid.
  void solid(const std::string& about);
  /// Told at the end, when all appear. `about`: what one must know to read it, or empty.
  void file(const std::string& path, const std::string& about = {});
  void profile(Profile& profile);
  /// All files of the command are given their names.
  void end(double seconds);

 private:
  void tell(const std::string& path, const std::string& about);
  void grown(const Run& run, std::size_t stage, const RunSummary& summary);
  /// What the unknowns live on, for the finest pattern.
  void nodes(const Run& run, double finest, const std::string& per);
  void line(const std::string& label, const std::string& text);

  Form form_;
  ProgressBar& bar_;
  Json json_ = Json::object();
  std::size_t warnings_of_run_ = 0;
  double bytes_ = 0;  ///< that the growth moved
  std::vector<std::pair<std::string, std::string>> files_;
  std::vector<std::string> solved_;  ///< the linear systems of every stage, in words
};

}  // namespace pelage
