#include "react/model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/ascii.h"
#include "base/fingerprint.h"
#include "base/number.h"
#include "base/suggest.h"
#include "react/derivative.h"
#include "react/diffusion_tensor.h"
#include "react/formula.h"
#include "react/gradient_terms.h"
#include "react/laplacian.h"
#include "react/linear_split.h"

namespace pelage {

namespace {

[[noreturn]] void fail(const std::string& message, const Location& where) { throw Error(Fault::usage, message, where); }

std::string range_text(const ParameterSource& parameter) {
  const std::string low = std::isfinite(parameter.min) ? exact_number(parameter.min) : "";
  const std::string high = std::isfinite(parameter.max) ? exact_number(parameter.max) : "";
  if (high.empty()) return "at least " + low;
  return low.empty() ? "at most " + high : "from " + low + " to " + high;
}

void require_in_range(const ParameterSource& parameter, const Location& where) {
  if (parameter.value >= parameter.min && parameter.value <= parameter.max && std::isfinite(parameter.value)) return;
  const std::string range =
      std::isfinite(parameter.min) || std::isfinite(parameter.max) ? range_text(parameter) : "finite";
  fail("parameter \"" + parameter.name + "\" is " + exact_number(parameter.value) + "; it must be " + range, where);
}

void apply_overrides(ModelSource& model, const Overrides& overrides) {
  for (const auto& [name, value] : overrides) {
    const auto same = [&name = name](const ParameterSource& parameter) { return parameter.name == name; };
    const auto found = std::ranges::find_if(model.parameters, same);
    if (found == model.parameters.end()) {
      std::vector<std::string> names;
      for (const ParameterSource& parameter : model.parameters) names.push_back(parameter.name);
      const std::string hint = did_you_mean(name, names);
      fail("model \"" + model.name + "\" has no parameter \"" + name + "\"; " +
               (hint.empty() ? "it has " + (names.empty() ? "none" : join_names(names)) : hint),
           value.where);
    }
    if (!found->reference) found->reference = found->value;
    found->value = value.value;
    require_in_range(*found, value.where);
  }
}

bool is_coupled(const Equations& equations, std::size_t i) {
  const std::size_t n = equations.species.size();
  bool coupled = equations.algebraic[i] && !equations.follows[i];
  for (std::size_t j = 0; j < n; ++j)
    coupled = coupled || equations.cross[i * n + j] != 0 || equations.cross[j * n + i] != 0;
  return coupled;
}

/// One compilation: source -> equations.
class Compiler {
 public:
  Compiler(const ModelSource& source, const ModelChanges& changes) : source_(source), changes_(changes) {}

  Equations compile() {
    if (source_.species.empty()) fail("model \"" + source_.name + "\" has no species", source_.where);
    add_species();
    add_parameters();
    add_definitions();
    add_changes();
    for (const SpeciesSource& species : source_.species) add_equation(species);
    find_followers();
    equations_.gradients = gradient_products(graph_, equations_.rate);
    add_own_fluxes();
    for (std::size_t i = 0; i < source_.species.size(); ++i) check_coupling(i);
    require_nothing_held_is_coupled();
    equations_.wavelength_law = number_law(source_.wavelength_law, "wavelength");
    equations_.period = number_law(source_.period, "period");
    add_jacobian();
    return std::move(equations_);
  }

 private:
  /// Refuses names that are no identifiers, reserved, or already taken.
  void claim(const std::string& name, const Location& where) {
    const auto is_part = [](char c) { return is_letter_or_digit(c) || c == '_'; };
    if (name.empty() || is_digit(name.front()) || !std::ranges::all_of(name, is_part))
      fail("\"" + name + "\" is not a name; use letters, digits and _, starting with a letter", where);
    if (std::ranges::count(reserved_names(), name) > 0)
      fail("\"" + name + "\" has a meaning in formulas already; choose another name", where);
    if (!taken_.insert(name).second) fail("\"" + name + "\" is given twice; choose another name", where);
  }

  void add_species() {
    for (const SpeciesSource& species : source_.species) {
      if (species.name == component_name(species.vector, 1)) claim(species.vector, species.where);
      claim(species.name, species.where);
      Symbol symbol{Symbol::Kind::species, static_cast<int>(equations_.species.size())};
      symbol.where = species.where;
      equations_.species.push_back(graph_.symbol(symbol));
      scope_.names[species.name] = equations_.species.back();
    }
  }

  void add_parameters() {
    for (const ParameterSource& parameter : source_.parameters) {
      claim(parameter.name, parameter.where);
      require_in_range(parameter, parameter.where);
      scope_.names[parameter.name] = graph_.constant(parameter.value);
    }
  }

  /// Parameters that are mapped are definitions before all others.
  void add_definitions() {
    if (changes_.points) {
      claim("points", *changes_.points);
      scope_.names["points"] = attribute("points", *changes_.points);
    }
    std::vector<const DefinitionSource*> all;
    for (const auto* list : {&changes_.maps, &source_.definitions})
      for (const DefinitionSource& definition : *list) all.push_back(&definition);
    for (const DefinitionSource* definition : all) {
      claim(definition->name, definition->formula.where);
      scope_.not_yet[definition->name] = "is defined further down; definitions use those above them";
    }
    for (const DefinitionSource* definition : all) {
      scope_.not_yet[definition->name] = "is being defined here; a definition cannot use itself";
      const NodeId id = parse_formula(graph_, definition->formula, scope_, "definitions." + definition->name);
      scope_.not_yet.erase(definition->name);
      scope_.names[definition->name] = id;
    }
  }

  NodeId attribute(const std::string& name, const Location& where) {
    Symbol symbol{Symbol::Kind::attribute};
    symbol.name = name;
    symbol.where = where;
    return graph_.symbol(symbol);
  }

  /// The formulas of a stage. Their labels keep the random fields of a formula apart from those of the model.
  void add_changes() {
    if (changes_.mask) {
      equations_.mask = parse_formula(graph_, *changes_.mask, scope_, "definitions.stage_mask");
      if (graph_[*equations_.mask].dependence & (on_species | on_time))
        fail("where concentrations are held cannot depend on them or on time", changes_.mask->where);
      inside_ = graph_.symbol({Symbol::Kind::mask});
    }
    for (const auto& [species, formula] : changes_.carried)
      initial_[species] = {attribute(formula.text, formula.where), formula.where};
    for (const auto& [species, formula] : changes_.initial)
      initial_[species] = {parse_formula(graph_, formula, scope_, "definitions.stage_initial_" + species),
                           formula.where};
    for (const auto& [species, formula] : changes_.pin)
      pin_[species] = {parse_formula(graph_, formula, scope_, "definitions.stage_pin_" + species), formula.where};
    if (changes_.size) size_ = parse_formula(graph_, *changes_.size, scope_, "definitions.stage_size");
  }

  /// Neither reaction nor diffusion inside of a mask that excludes.
  NodeId outside(NodeId id) {
    return changes_.mask && changes_.excluded ? graph_.make(Op::select, inside_, graph_.constant(0), id) : id;
  }

  /// Lengths scale with the root of the diffusion, and with the rates of an anisotropic one.
  NodeId scaled_diffusion(NodeId id) {
    if (size_) id = graph_.make(Op::multiply, id, graph_.make(Op::power, *size_, graph_.constant(2)));
    return outside(id);
  }
  NodeId scaled_rate(NodeId id) { return outside(size_ ? graph_.make(Op::multiply, id, *size_) : id); }

  NodeId parse(const SpeciesSource& species, const std::string& key, const std::optional<Formula>& formula,
               double otherwise) {
    if (!formula) return graph_.constant(otherwise);
    const bool flows = key == "diffusion" || key == "C0" || key == "C1" || key.find('.') != std::string::npos;
    // Components share their diffusion, random fields in it included.
    const std::string& owner = flows && !species.vector.empty() ? species.vector : species.name;
    const NodeId id = parse_formula(graph_, *formula, scope_, "species." + owner + "." + key);
    const std::string found = key == "rate" ? "" : differential_operator(graph_, id);
    if (found.empty() || (key == "equals" && found != "div()")) return id;
    fail(found + " can stand in `rate`" + (found == "div()" ? "" : " and in `equals`") + " only" +
             (flows ? "; make a species that equals it" : ""),
         formula->where);
  }

  NodeId require_initial(NodeId id, const Location& where) {
    if (graph_[id].dependence & (on_species | on_time))
      fail("initial values cannot depend on species or on time", where);
    return id;
  }

  void add_initial(const SpeciesSource& species) {
    if (const auto changed = initial_.find(species.name); changed != initial_.end())
      equations_.initial.push_back(require_initial(changed->second.id, changed->second.where));
    else
      equations_.initial.push_back(require_initial(parse(species, "initial", species.initial, 0),
                                                   species.initial ? species.initial->where : species.where));
    equations_.pin.emplace_back();
    if (const auto pinned = pin_.find(species.name); pinned != pin_.end())
      equations_.pin.back() = require_initial(pinned->second.id, pinned->second.where);
  }

  void add_equation(const SpeciesSource& species) {
    if (species.equals) require_nothing_else(species);
    equations_.algebraic.push_back(species.equals.has_value());
    add_diffusion(species);
    add_rate(species);
    add_initial(species);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    equations_.lower.push_back(bound(species, "min", species.lower, -infinity));
    equations_.upper.push_back(bound(species, "max", species.upper, infinity));
    if (!(equations_.lower.back() <= equations_.upper.back()))
      fail("the lower bound of species \"" + species.name + "\" is above its upper bound", species.lower->where);
  }

  static const Location& directional_where(const SpeciesSource& species) {
    return species.anisotropy ? species.anisotropy->a1.where : species.tensor->front().where;
  }

  void require_nothing_else(const SpeciesSource& species) {
    if (const auto changed = initial_.find(species.name); changed != initial_.end())
      fail("species \"" + species.name + "\" is determined by `equals`; give nothing else beside it",
           changed->second.where);
    if (species.anisotropy || species.tensor)
      fail("species \"" + species.name + "\" is determined by `equals`; give nothing else beside it",
           directional_where(species));
    for (const auto* other : {&species.diffusion, &species.rate, &species.c0, &species.c1, &species.c2, &species.c3,
                              &species.initial, &species.lower, &species.upper})
      if (*other)
        fail("species \"" + species.name + "\" is determined by `equals`; give nothing else beside it",
             (*other)->where);
  }

  NodeId parse_anisotropy(const SpeciesSource& species, const std::string& key, const Formula& formula) {
    const NodeId id = parse(species, "anisotropy." + key, formula, 0);
    if (graph_[id].dependence & (on_species | on_time))
      fail("an anisotropy cannot depend on species or on time", formula.where);
    return id;
  }

  void add_anisotropic_diffusion(const SpeciesSource& species) {
    for (const auto* other : {&species.diffusion, &species.c0, &species.c1})
      if (*other)
        fail("species \"" + species.name + "\": give anisotropy, or " +
                 (other == &species.diffusion ? "diffusion" : "C0 and C1") + ", not both",
             (*other)->where);
    if (species.tensor)
      fail("species \"" + species.name + "\": give anisotropy, or tensor, not both", species.tensor->front().where);
    const AnisotropySource& a = *species.anisotropy;
    const Anisotropy nodes{parse_anisotropy(species, "theta", a.theta),
                           scaled_rate(parse_anisotropy(species, "a1", a.a1)),
                           scaled_rate(parse_anisotropy(species, "a2", a.a2))};
    equations_.anisotropy.emplace_back(nodes);
    equations_.prefactor.push_back(graph_.constant(1));
    const Term across{&graph_, nodes.a2};
    equations_.diffusion.push_back((across * across).id);
  }

  void add_tensor_diffusion(const SpeciesSource& species) {
    for (const auto* other : {&species.diffusion, &species.c1})
      if (*other)
        fail("species \"" + species.name + "\": give tensor, or " + (other == &species.diffusion ? "diffusion" : "C1") +
                 ", not both",
             (*other)->where);
    Term c0{&graph_, parse(species, "C0", species.c0, 1)};
    std::array<NodeId, 6> tensor;
    const bool even = graph_.constant_value(c0.id).has_value();
    for (std::size_t k = 0; k < tensor.size(); ++k) {
      const Term entry{&graph_, scaled_diffusion(parse(species, std::string("tensor.") + tensor_entries[k],
                                                       (*species.tensor)[k], 0))};
      tensor[k] = even ? (c0 * entry).id : entry.id;
    }
    require_diffusing(species, tensor);
    equations_.tensor.emplace_back(tensor);
    equations_.prefactor.push_back(even ? graph_.constant(1) : c0.id);
    const Term xx{&graph_, tensor[0]}, yy{&graph_, tensor[3]}, zz{&graph_, tensor[5]};
    equations_.diffusion.push_back((1.0 / 3 * (xx + yy + zz)).id);
  }

  /// What is known of a tensor before it meets any place.
  void require_diffusing(const SpeciesSource& species, const std::array<NodeId, 6>& nodes) {
    std::array<double, 6> tensor{};
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const auto value = graph_.constant_value(nodes[k]);
      if (!value) return;
      tensor[k] = *value;
    }
    if (!positive_semidefinite(tensor))
      fail("the tensor of species \"" + species.name +
               "\" would gather instead of spread in some direction; it must be " + "positive semidefinite",
           species.tensor->front().where);
  }

  void add_diffusion(const SpeciesSource& species) {
    if (species.anisotropy || !species.tensor) equations_.tensor.emplace_back();
    if (species.anisotropy) return add_anisotropic_diffusion(species);
    equations_.anisotropy.emplace_back();
    if (species.tensor) return add_tensor_diffusion(species);
    const bool coefficients = species.c0 || species.c1;
    if (species.diffusion && coefficients)
      fail("species \"" + species.name + "\": give diffusion, or C0 and C1, not both", species.where);
    Term c0{&graph_, parse(species, "C0", species.c0, 1)};
    Term c1{&graph_, scaled_diffusion(coefficients ? parse(species, "C1", species.c1, 1)
                                                   : parse(species, "diffusion", species.diffusion, 0))};
    if (graph_.constant_value(c0.id)) {
      c1 = c0 * c1;
      c0.id = graph_.constant(1);
    }
    if (const auto constant = graph_.constant_value(c1.id); constant && !(*constant >= 0 && std::isfinite(*constant)))
      fail("the diffusion of species \"" + species.name + "\" is " + exact_number(*constant) + "; it must be 0 or more",
           (species.diffusion ? species.diffusion
            : species.c1      ? species.c1
                              : species.c0)
               ->where);
    equations_.prefactor.push_back(c0.id);
    equations_.diffusion.push_back(c1.id);
  }

  void add_rate(const SpeciesSource& species) {
    const bool coefficients = species.c2 || species.c3;
    if (species.rate && coefficients)
      fail("species \"" + species.name + "\": give rate, or C2 and C3, not both", species.where);
    if (!species.rate && !species.equals && !coefficients)
      fail("species \"" + species.name + "\" has no rate; give rate, or C2 and C3", species.where);
    const Term u{&graph_, scope_.names.find(species.name)->second};
    NodeId rate;
    LinearSplit split;
    bool laplacians = false;
    if (species.rate || species.equals) {
      rate = species.rate ? outside(scaled_gradients(without_fluxes(parse(species, "rate", species.rate, 0), species)))
                          : parse(species, "equals", species.equals, 0);
      laplacians = has_laplacian(graph_, rate);
      if (laplacians) rate = without_laplacians(rate, species);
      split = linear_split(graph_, rate, u.id);
    } else {
      split = {outside(parse(species, "C2", species.c2, 0)), outside(parse(species, "C3", species.c3, 0))};
      rate = (Term{&graph_, split.c2} * u + Term{&graph_, split.c3}).id;
    }
    const bool diffuses = species.diffusion || species.anisotropy || species.tensor || species.c0 || species.c1 ||
                          laplacians || own_flux(equations_.rate.size());
    if (!diffuses && !species.equals)
      fail("species \"" + species.name + "\" has no diffusion; give 0 if it does not diffuse", species.where);
    has_laplacian_.push_back(laplacians);
    equations_.rate.push_back(rate);
    equations_.c2.push_back(split.c2);
    equations_.c3.push_back(split.c3);
  }

  /// Moves the Laplacians into `cross`, and the species' own into `diffusion`.
  NodeId without_laplacians(NodeId rate, const SpeciesSource& species) {
    const std::size_t n = equations_.species.size(), i = equations_.rate.size();
    std::vector<std::string> names;
    for (const SpeciesSource& s : source_.species) names.push_back(s.name);
    const Formula& formula = species.rate ? *species.rate : *species.equals;
    const LaplacianSplit split = split_laplacians(graph_, rate, equations_.species, names, formula.where);
    equations_.cross.resize(n * n, 0.0);
    for (std::size_t j = 0; j < n; ++j)
      if (j != i) equations_.cross[i * n + j] = split.coefficient[j];
    const Term c0{&graph_, equations_.prefactor[i]}, c1{&graph_, equations_.diffusion[i]};
    equations_.diffusion[i] = (c1 + split.coefficient[i] / c0).id;
    return split.rest;
  }

  /// Moves div() into `fluxes`.
  NodeId without_fluxes(NodeId rate, const SpeciesSource& species) {
    const FluxSplit split = split_fluxes(graph_, rate, species.rate->where);
    for (const Flux& flux : split.fluxes)
      equations_.fluxes.push_back({equations_.rate.size(), flux.of, scaled_diffusion(flux.coefficient)});
    return split.rest;
  }

  /// Products of gradients are those of a larger pattern.
  NodeId scaled_gradients(NodeId rate) {
    if (!size_) return rate;
    return rewrite(graph_, std::array{rate}, [&](NodeId id) -> std::optional<NodeId> {
      if (graph_[id].op != Op::symbol || graph_.symbol_of(id).kind != Symbol::Kind::gradients) return std::nullopt;
      return graph_.make(Op::multiply, id, graph_.make(Op::power, *size_, graph_.constant(2)));
    })[0];
  }

  const Flux* own_flux(std::size_t i) const {
    const auto own =
        std::ranges::find_if(equations_.fluxes, [&](const Flux& f) { return f.species == i && f.of == i; });
    return own == equations_.fluxes.end() ? nullptr : &*own;
  }

  /// What drives a species down its own gradient is diffusion, which is implicit, unless that has to be a number.
  void add_own_fluxes() {
    for (const Flux& flux : equations_.fluxes)
      if (!graph_.constant_value(equations_.prefactor[flux.species]))
        fail("C0 of species \"" + source_.species[flux.species].name + "\" varies; its rate cannot contain div()",
             source_.species[flux.species].c0->where);
    for (std::size_t i = 0; i < equations_.species.size(); ++i) {
      const Flux* own = own_flux(i);
      if (own && (equations_.anisotropy[i] || equations_.tensor[i]))
        fail("species \"" + source_.species[i].name +
                 "\" is anisotropic; its rate cannot contain div() of its own gradient",
             source_.species[i].rate->where);
      if (!own || is_coupled(equations_, i)) continue;
      equations_.diffusion[i] = graph_.make(Op::add, equations_.diffusion[i], own->coefficient);
      equations_.fluxes.erase(equations_.fluxes.begin() + (own - equations_.fluxes.data()));
    }
  }

  /// Algebraic species that have no Laplacian, and whose values and Laplacians no equation of another reads.
  void find_followers() {
    const std::size_t n = equations_.species.size();
    equations_.cross.resize(n * n, 0.0);
    equations_.follows = equations_.algebraic;
    for (std::size_t i = 0; i < n; ++i) {
      if (has_laplacian_[i]) equations_.follows[i] = 0;
      for (std::size_t j = 0; j < n; ++j)
        if (equations_.cross[i * n + j] != 0) equations_.follows[i] = equations_.follows[j] = 0;
      const auto& a = equations_.anisotropy[i];
      std::vector<NodeId> read = {equations_.rate[i], equations_.prefactor[i], equations_.diffusion[i]};
      if (a) read.insert(read.end(), {a->theta, a->a1, a->a2});
      if (const auto& t = equations_.tensor[i]) read.insert(read.end(), t->begin(), t->end());
      for (const Flux& flux : equations_.fluxes)
        if (flux.species == i) read.insert(read.end(), {flux.coefficient, equations_.species[flux.of]});
      for (const std::size_t j : species_in(read))
        if (j != i) equations_.follows[j] = 0;
    }
  }

  /// The species whose values or gradients formulas read.
  std::vector<std::size_t> species_in(const std::vector<NodeId>& formulas) const {
    std::vector<std::size_t> list;
    for (const NodeId id : reachable(graph_, formulas)) {
      if (graph_[id].op != Op::symbol) continue;
      const Symbol& symbol = graph_.symbol_of(id);
      const bool gradients = symbol.kind == Symbol::Kind::gradients;
      if (gradients || symbol.kind == Symbol::Kind::species) list.push_back(static_cast<std::size_t>(symbol.index));
      if (gradients) list.push_back(static_cast<std::size_t>(symbol.other));
    }
    return list;
  }

  /// What Laplacians and algebraic species ask of an equation; known when all are.
  void check_coupling(std::size_t i) {
    const SpeciesSource& species = source_.species[i];
    const auto diffusion = graph_.constant_value(equations_.diffusion[i]);
    const bool coupled = is_coupled(equations_, i);
    if ((species.anisotropy || species.tensor) && (coupled || has_laplacian_[i]))
      fail("species \"" + species.name + "\" is anisotropic; its equations cannot contain lap()",
           directional_where(species));
    if (coupled && !(diffusion && graph_.constant_value(equations_.prefactor[i])))
      fail("the diffusion of species \"" + species.name +
               "\" varies; one that is linked to others by lap() must be made of numbers and parameters",
           (species.diffusion ? species.diffusion
            : species.c1      ? species.c1
                              : species.c0)
               ->where);
    if (!coupled && diffusion && *diffusion < 0)
      fail("diffusion and lap(" + species.name + ") in the rate of \"" + species.name + "\" add up to " +
               exact_number(*diffusion) + "; it must be 0 or more",
           species.rate->where);
    if (species.equals) check_algebraic(i);
  }

  void check_algebraic(std::size_t i) {
    const SpeciesSource& species = source_.species[i];
    for (const std::size_t j : species_in({equations_.rate[i]})) {
      if (equations_.algebraic[j])
        fail("`equals` of \"" + species.name + "\" uses \"" + source_.species[j].name +
                 "\" outside of lap(), which has no rate of its own; write its formula out",
             species.equals->where);
    }
    if (std::ranges::count(equations_.algebraic, 0) == 0)
      fail("model \"" + source_.name + "\" has no species with a rate", source_.where);
  }

  double bound(const SpeciesSource& species, const std::string& key, const std::optional<Formula>& formula,
               double otherwise) {
    const auto value = graph_.constant_value(parse(species, key, formula, otherwise));
    if (!value || std::isnan(*value)) fail("a bound must be a number or made of parameters", formula->where);
    return *value;
  }

  void require_nothing_held_is_coupled() {
    if (!changes_.mask) return;
    for (std::size_t i = 0; i < source_.species.size(); ++i)
      if (is_coupled(equations_, i))
        fail("concentrations that are linked by lap() cannot be held", changes_.mask->where);
  }

  std::optional<NodeId> number_law(const std::optional<Formula>& formula, const char* name) {
    if (!formula) return {};
    const NodeId id = parse_formula(graph_, *formula, scope_, name);
    if (graph_[id].dependence & (on_species | on_time))
      fail("a " + std::string(name) + " must be a number or made of parameters", formula->where);
    return id;
  }

  void add_jacobian() {
    const std::size_t n = equations_.species.size();
    equations_.jacobian.resize(n * n);
    for (std::size_t j = 0; j < n; ++j) {
      const auto column = derivative(graph_, equations_.rate, equations_.species[j]);
      for (std::size_t i = 0; i < n; ++i) equations_.jacobian[i * n + j] = column[i];
    }
  }

  struct LocatedNode {
    NodeId id;
    Location where;
  };
  const ModelSource& source_;
  const ModelChanges& changes_;
  std::map<std::string, LocatedNode> initial_, pin_;  ///< of the stage, by species
  NodeId inside_ = -1;                                ///< the mask, as rates and diffusions know it
  std::optional<NodeId> size_;
  Equations equations_;
  Graph& graph_ = equations_.graph;
  Scope scope_;
  std::vector<char> has_laplacian_;  ///< whether a species' own formula contains lap()
  std::set<std::string> taken_;
};

}  // namespace

ModelSource with_variant(ModelSource source, const std::string& variant) {
  std::vector<std::string> names;
  for (const VariantSource& candidate : source.variants) {
    names.push_back(candidate.name);
    if (candidate.name != variant) continue;
    apply_overrides(source, candidate.parameters);
    for (ParameterSource& parameter : source.parameters) parameter.reference.reset();
    if (candidate.period) source.period = candidate.period;
    source.wavelength = candidate.wavelength;  // that of other parameter values says nothing about these
    if (candidate.wavelength_law) source.wavelength_law = candidate.wavelength_law;
    const Suggestions& suggested = candidate.suggestions;
    if (suggested.step) source.suggestions.step = suggested.step;
    if (suggested.end) source.suggestions.end = suggested.end;
    if (suggested.tolerance) source.suggestions.tolerance = suggested.tolerance;
    if (suggested.resolution) source.suggestions.resolution = suggested.resolution;
    if (suggested.iterations) source.suggestions.iterations = suggested.iterations;
    if (!candidate.title.empty()) source.title = candidate.title;
    return source;
  }
  const std::string hint = did_you_mean(variant, names);
  fail("model \"" + source.name + "\" has no variant \"" + variant + "\"; " +
           (hint.empty() ? "it has " + (names.empty() ? "none" : join_names(names)) : hint),
       {});
}

std::optional<double> Model::period() const {
  const auto node = equations().period;
  const auto value = node ? equations().graph.constant_value(*node) : std::nullopt;
  return value && *value > 0 && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<double> Model::diffusion_constant(std::size_t i) const {
  const Graph& graph = equations_->graph;
  if (has_tensor(i) || !graph.constant_value(equations_->prefactor[i])) return std::nullopt;
  return graph.constant_value(equations_->diffusion[i]);
}

std::vector<std::size_t> Model::coupled() const {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < species_count(); ++i)
    if (is_coupled(*equations_, i)) list.push_back(i);
  return list;
}

bool Model::anisotropic() const {
  return std::ranges::any_of(equations_->anisotropy, [](const auto& a) { return a.has_value(); });
}

bool Model::has_tensor() const {
  return std::ranges::any_of(equations_->tensor, [](const auto& t) { return t.has_value(); });
}

bool Model::same_diffusion(std::size_t i, std::size_t j) const {
  const Equations& e = *equations_;
  return e.prefactor[i] == e.prefactor[j] && e.diffusion[i] == e.diffusion[j] && e.anisotropy[i] == e.anisotropy[j] &&
         e.tensor[i] == e.tensor[j];
}

bool Model::jumps() const {
  const Graph& graph = equations_->graph;
  std::vector<NodeId> rates;
  for (std::size_t i = 0; i < species_count(); ++i)
    if (!follows(i)) rates.push_back(equations_->rate[i]);
  return std::ranges::any_of(reachable(graph, rates), [&](NodeId id) {
    const NodeId decides = graph[id].op == Op::select ? graph[id].in[0] : id;
    return has_jumps(graph[id].op) && (graph[decides].dependence & on_species) != 0;
  });
}

bool Model::varying_prefactor(std::size_t i) const {
  return !equations_->graph.constant_value(equations_->prefactor[i]);
}

unsigned Model::diffusion_dependence(std::size_t i) const {
  const Graph& graph = equations_->graph;
  unsigned varies = graph[equations_->prefactor[i]].dependence | graph[equations_->diffusion[i]].dependence;
  if (const auto& tensor = equations_->tensor[i])
    for (const NodeId entry : *tensor) varies |= graph[entry].dependence;
  return varies;
}

namespace {

void add_graph(Fingerprint& f, const Graph& graph) {
  for (NodeId id = 0; id < static_cast<NodeId>(graph.size()); ++id) {
    const Node& node = graph[id];
    f.add(static_cast<std::uint64_t>(node.op)).add(node.value);
    if (node.op != Op::symbol) {
      for (const NodeId operand : node.in) f.add(static_cast<std::uint64_t>(operand));
      continue;
    }
    const Symbol& s = graph.symbol_of(id);
    f.add(static_cast<std::uint64_t>(s.kind)).add(static_cast<std::uint64_t>(s.index)).add(s.name);
    f.add(s.stream).add(s.length);
    if (s.other >= 0) f.add(static_cast<std::uint64_t>(s.other));
  }
}

}  // namespace

std::uint64_t Model::fingerprint() const {
  const Equations& e = *equations_;
  Fingerprint f;
  add_graph(f, e.graph);
  for (const auto* list : {&e.rate, &e.c2, &e.c3, &e.prefactor, &e.diffusion, &e.initial})
    for (const NodeId id : *list) f.add(static_cast<std::uint64_t>(id));
  for (const Flux& flux : e.fluxes)
    f.add(std::uint64_t{flux.species}).add(std::uint64_t{flux.of}).add(static_cast<std::uint64_t>(flux.coefficient));
  for (const auto& a : e.anisotropy)
    for (const NodeId id : a ? std::array{a->theta, a->a1, a->a2} : std::array{-1, -1, -1})
      f.add(static_cast<std::uint64_t>(id));
  for (const auto& tensor : e.tensor)
    if (tensor)
      for (const NodeId entry : *tensor) f.add(static_cast<std::uint64_t>(entry));
  for (const auto& pin : e.pin) f.add(static_cast<std::uint64_t>(pin.value_or(-1)));
  f.add(static_cast<std::uint64_t>(e.mask.value_or(-1)));
  for (const char algebraic : e.algebraic) f.add(static_cast<std::uint64_t>(algebraic));
  f.add_all(e.cross).add_all(e.lower).add_all(e.upper);
  return f.value();
}

Model compile(const ModelSource& source, const Overrides& overrides, const ModelChanges& changes) {
  ModelSource changed = source;
  apply_overrides(changed, overrides);
  for (const DefinitionSource& map : changes.maps)
    std::erase_if(changed.parameters, [&](const ParameterSource& p) { return p.name == map.name; });
  Model model;
  model.equations_ = std::make_shared<const Equations>(Compiler(changed, changes).compile());
  model.source_ = std::make_shared<const ModelSource>(std::move(changed));
  return model;
}

}  // namespace pelage
