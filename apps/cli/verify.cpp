// pelage verify: what this build achieves, beside what it must.

#include <cstdio>
#include <memory>

#include "command.h"
#include "pelage/error.h"
#include "text.h"
#include "verify/figure.h"

namespace pelage {

namespace {

using Group = std::vector<Figure> (*)();

constexpr Group groups[] = {verify_basis,         verify_matrices,     verify_convergence, verify_eigenvalues,
                            verify_time_steppers, verify_early_growth, verify_size};

void print_figure(const Figure& f) {
  std::printf("%s %s   %s (at %s %s)\n", f.passed() ? "ok  " : "FAIL", f.what.c_str(), number(f.value).c_str(),
              f.at_least ? "least" : "most", number(f.bound).c_str());
  std::fflush(stdout);
}

Json to_json(const Figure& f) {
  return {{"what", f.what},
          {"value", json_number(f.value)},
          {"bound", json_number(f.bound)},
          {"bound_is", f.at_least ? "minimum" : "maximum"},
          {"passed", f.passed()}};
}

void verify(bool json) {
  Json list = Json::array();
  std::size_t failed = 0;
  for (const Group group : groups)
    for (const Figure& f : group()) {
      failed += !f.passed();
      if (json)
        list.push_back(to_json(f));
      else
        print_figure(f);
    }
  if (json) print_json(list);
  if (failed == 0) return;
  throw Error(Fault::numerics,
              counted(failed, "figure") + " beyond the bound: do not trust this build; please report it");
}

}  // namespace

Command add_verify(CLI::App& parent) {
  auto json = std::make_shared<bool>(false);
  CLI::App* app = parent.add_subcommand(
      "verify",
      "Measure how exact this build is\n"
      "Computes the figures by which the method is judged (derivatives, invariants, orders of convergence, "
      "eigenvalues, wavelengths) and prints each beside its bound. Takes minutes. Exit code 4 if one fails.");
  app->add_flag("--json", *json, "Print the result as JSON");
  app->footer("Examples:\n  pelage verify\n  pelage verify --json > figures.json");
  return {app, [json] { verify(*json); }};
}

}  // namespace pelage
