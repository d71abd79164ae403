#include <pybind11/complex.h>
#include <pybind11/stl.h>

#include "bindings.h"
#include "calls.h"
#include "pelage/analyse.h"
#include "pelage/measure.h"

namespace pelage::python {

namespace {

const char* name_of(Regime regime) {
  switch (regime) {
    case Regime::no_state:
      return "no_state";
    case Regime::quiet:
      return "quiet";
    case Regime::marginal:
      return "marginal";
    case Regime::turing:
      return "turing";
    case Regime::waves:
      return "waves";
    case Regime::oscillation:
      return "oscillation";
    case Regime::departure:
      return "departure";
    case Regime::mixed:
      return "mixed";
    case Regime::ever_shorter:
      break;
  }
  return "ever_shorter";
}

/// Growth rates, and angular frequencies as imaginary parts, of waves of these wave numbers.
py::array dispersion(const Analysis& a, const Numbers<double>& wave_numbers) {
  std::vector<std::complex<double>> rates;
  for (py::ssize_t i = 0; i < wave_numbers.size(); ++i)
    rates.push_back(growth_rate(a.stability, wave_numbers.data()[i]));
  return owned<std::complex<double>>(std::move(rates),
                                     Extent(wave_numbers.shape(), wave_numbers.shape() + wave_numbers.ndim()));
}

py::dict about(const PatternPhase& p) {
  py::dict all;
  all["parts"] = p.parts;
  all["share"] = p.share;
  all["width"] = p.width;
  return all;
}

py::dict about(const PatternMeasures& m) {
  py::dict all, spots, spectrum;
  spots["count"] = m.spots.count;
  spots["diameter"] = m.spots.diameter;
  spots["nearest"] = m.spots.nearest;
  spots["neighbours"] = m.spots.neighbours;
  spectrum["wave_number"] = owned_numbers(m.spectrum.wave_number);
  spectrum["share"] = owned_numbers(m.spectrum.share);
  spectrum["peak"] = m.spectrum.empty() ? 0.0 : m.spectrum.peak();
  all["area"] = m.area;
  all["minimum"] = m.minimum;
  all["maximum"] = m.maximum;
  all["mean"] = m.mean;
  all["deviation"] = m.deviation;
  all["level"] = m.level;
  all["above"] = about(m.above);
  all["below"] = about(m.below);
  all["border"] = m.border;
  all["wavelength"] = m.wavelength;
  all["spacing"] = m.spacing;
  all["coherence"] = m.coherence;
  all["along"] = m.along;
  all["defects"] = py::make_tuple(m.defects.plus, m.defects.minus);
  all["spots"] = spots;
  all["spectrum"] = spectrum;
  return all;
}

py::list about(const std::vector<Condition>& conditions) {
  py::list all;
  for (const Condition& c : conditions) all.append(py::make_tuple(c.text, c.holds));
  return all;
}

ModelTexts texts_of(const std::map<std::string, std::string>& models) {
  ModelTexts texts;
  for (const auto& [name, text] : models) texts[name] = {text, name};
  return texts;
}

}  // namespace

void bind_analysis(py::module_& m) {
  py::class_<Analysis>(m, "Analysis")
      .def_readonly("title", &Analysis::title)
      .def_readonly("parameters", &Analysis::parameters)
      .def_readonly("species", &Analysis::species)
      .def_property_readonly("regime", [](const Analysis& a) { return name_of(a.regime); })
      .def_readonly("verdict", &Analysis::verdict)
      .def_readonly("spacing", &Analysis::spacing)
      .def_property_readonly("wavelength", [](const Analysis& a) { return a.stability.wavelength; })
      .def_property_readonly("growth", [](const Analysis& a) { return a.stability.growth; })
      .def_property_readonly("oscillatory", [](const Analysis& a) { return a.stability.oscillatory; })
      .def_property_readonly(
          "band", [](const Analysis& a) { return std::make_pair(a.stability.band_min, a.stability.band_max); })
      .def_property_readonly("steady_states", [](const Analysis& a) { return a.stability.steady_states; })
      .def_property_readonly("chosen", [](const Analysis& a) { return a.stability.chosen; })
      .def_property_readonly("eigenvalues", [](const Analysis& a) { return a.stability.eigenvalues; })
      .def_property_readonly("conditions", [](const Analysis& a) { return about(a.conditions); })
      .def_readonly("thresholds", &Analysis::thresholds_in_words)
      .def_property_readonly("largest_steps",
                             [](const Analysis& a) {
                               std::map<std::string, double> steps;
                               for (const StepLimit& s : a.largest_steps) steps[s.stepper] = s.step;
                               return steps;
                             })
      .def("dispersion", &dispersion);
  m.def("analyse", [](const std::string& model, const std::map<std::string, double>& parameters,
                      const std::map<std::string, std::string>& models) {
    const ModelTexts texts = texts_of(models);
    py::gil_scoped_release release;
    return analyse(model, parameters, texts);
  });
  m.def("measure", [](const ShapeFile& shape, const std::string& field, const std::optional<double>& level) {
    const PatternMeasures measures = [&] {
      py::gil_scoped_release release;
      return measure(shape, field, level);
    }();
    return about(measures);
  });
}

}  // namespace pelage::python
