// Every parameter of every shipped model may be anywhere in its range: a run then ends, or says why not, and soon.
#include <gtest/gtest.h>

#include "catalog/bind.h"
#include "catalog/models.h"
#include "shape/generators.h"
#include "verify/finished_pattern.h"

namespace pelage {
namespace {

/// The run of a model with one parameter changed to its `share` of the suggested time, on a mesh that is far too coarse
/// for its pattern; nothing where it is refused, with a message.
std::optional<RunSummary> run_with(const std::string& model, const std::vector<Stage::Setting>& parameters,
                                   double share) {
  Recipe recipe;
  recipe.stages[0].model.value = model;
  recipe.stages[0].parameters = parameters;
  recipe.stages[0].size = Given<Length>{{0.9, Length::Unit::world}, {}};
  try {
    Program program = make_program(recipe, builtin_shape("builtin:sphere?n=162"));
    program.edge = 1e9;  // the mesh as it is
    program.stages[0].until *= share;
    Run run(std::move(program));
    return run.advance(1'000'000'000);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::usage);
    EXPECT_NE(std::string(error.what()).find(model), std::string::npos) << error.what();
    return std::nullopt;
  }
}

TEST(ParameterEnds, RunsEndThere) {
  for (const ModelEntry& entry : model_list()) {
    if (entry.name.find(':') != std::string::npos) continue;
    for (const ParameterSource& p : entry.source.parameters)
      for (const double value : {p.min, p.max}) {
        const auto summary = run_with(entry.name, {{p.name, value, {}}}, 0.02);
        if (!summary) continue;
        EXPECT_NE(summary->status, RunStatus::running) << entry.name << ' ' << p.name << " = " << value;
        EXPECT_EQ(summary->status == RunStatus::failed, !summary->message.empty());
      }
  }
}

/// v is gone after a while; the rest must go on in steps of full size.
TEST(ParameterEnds, ASpeciesThatDiesOutCostsNoSteps) {
  const auto summary = run_with("gray-scott", {{"F", 0.02, {}}, {"k", 0.07, {}}}, 1);
  ASSERT_TRUE(summary);
  EXPECT_NE(summary->status, RunStatus::failed) << summary->message;
  EXPECT_LT(summary->steps, 1500);  // 1250 of the suggested size
}

}  // namespace
}  // namespace pelage
