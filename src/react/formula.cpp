#include "react/formula.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/random.h"
#include "base/suggest.h"
#include "react/functions.h"
#include "react/language.h"

namespace pelage {

namespace {

// Deep enough for every formula written by hand, shallow enough for the smallest stack (browsers: 64 kB).
constexpr int deepest_nesting = 100;

const Symbol* built_in_symbol(std::string_view name) {
  using Kind = Symbol::Kind;
  static const std::map<std::string, Symbol, std::less<>> symbols = {
      {"t", {Kind::time}},
      {"x", {Kind::position, 0}},
      {"y", {Kind::position, 1}},
      {"z", {Kind::position, 2}},
      {"bx", {Kind::box_position, 0}},
      {"by", {Kind::box_position, 1}},
      {"bz", {Kind::box_position, 2}},
      {"nx", {Kind::normal_vector, 0}},
      {"ny", {Kind::normal_vector, 1}},
      {"nz", {Kind::normal_vector, 2}},
      {"k1", {Kind::curvature, 0}},
      {"k2", {Kind::curvature, 1}},
  };
  const auto found = symbols.find(name);
  return found == symbols.end() ? nullptr : &found->second;
}

/// STAGE.SPECIES: a field that is finished.
bool is_stage_field(std::string_view name) { return name.find('.') != std::string_view::npos; }

/// FNV-1a, a hash of text that is the same on every machine.
std::uint64_t text_hash(std::string_view text) {
  std::uint64_t key = 0xcbf29ce484222325ULL;
  for (const char c : text) key = (key ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return key;
}

/// What people write for things that have another name here, and what to do.
std::string written_otherwise(std::string_view word) {
  static const std::map<std::string, std::string, std::less<>> known = {
      {"laplacian", "the Laplacian of u is written lap(u)"},
      {"laplace", "the Laplacian of u is written lap(u)"},
      {"del2", "the Laplacian of u is written lap(u)"},
      {"nabla", "|grad u|^2 is written grad2(u), the Laplacian of u lap(u)"},
      {"gradient", "|grad u|^2 is written grad2(u), and grad u . grad v dot(grad u, grad v)"},
      {"gradsq", "|grad u|^2 is written grad2(u)"},
      {"divergence", "the divergence of a flux is written div(c grad u)"},
      {"bilap", "the Laplacian of lap(u) is lap(w) of a species w that equals lap(u)"},
      {"biharmonic", "the Laplacian of lap(u) is lap(w) of a species w that equals lap(u)"},
      {"erfc", "erfc(a) is written 1 - erf(a)"},
      {"sgn", "the sign of a is written sign(a)"},
      {"signum", "the sign of a is written sign(a)"},
      {"sech", "sech(a) is written 1/cosh(a)"},
      {"fabs", "the modulus of a is written abs(a)"},
      {"rand", "random numbers are uniform(0, 1), normal(mean, deviation) or noise(length)"},
      {"random", "random numbers are uniform(0, 1), normal(mean, deviation) or noise(length)"},
      {"randn", "random numbers are uniform(0, 1), normal(mean, deviation) or noise(length)"},
      {"time", "the time is written t"},
  };
  const auto found = known.find(word);
  return found == known.end() ? "" : found->second;
}

class Parser {
 public:
  Parser(Graph& graph, const Formula& formula, const Scope& scope, std::string_view label)
      : graph_(graph),
        scope_(scope),
        tokens_(tokenize(formula)),
        label_(text_hash(label)),
        component_(formula.component) {}

  NodeId parse() {
    const NodeId result = disjunction();
    if (peek().kind != Token::Kind::end) expected("an operator or the end of the formula");
    return result;
  }

 private:
  /// Counts the levels of nesting for as long as it lives.
  class Level {
   public:
    explicit Level(Parser& parser) : depth_(parser.depth_) {
      if (++depth_ > deepest_nesting)
        throw Error(Fault::usage,
                    "more than " + std::to_string(deepest_nesting) + " levels of nesting: split into definitions",
                    parser.peek().where);
    }
    ~Level() { --depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    int& depth_;
  };

  const Token& peek() const { return tokens_[position_]; }
  bool sees(std::string_view text) const { return peek().kind != Token::Kind::end && peek().text == text; }
  const Token& take() { return tokens_[peek().kind == Token::Kind::end ? position_ : position_++]; }
  bool accept(std::string_view text) {
    if (!sees(text)) return false;
    take();
    return true;
  }
  [[noreturn]] void expected(const std::string& what) const {
    const std::string found =
        peek().kind == Token::Kind::end ? "the formula ends here" : "found '" + std::string(peek().text) + "'";
    throw Error(Fault::usage, "expected " + what + ", " + found, peek().where);
  }
  NodeId make(Op op, NodeId a, NodeId b = -1) { return graph_.make(op, a, b); }

  NodeId disjunction();
  NodeId conjunction();
  NodeId negation();
  NodeId comparison();
  NodeId sum();
  NodeId product();
  NodeId signed_power();
  NodeId power();
  NodeId primary();
  NodeId parenthesis();
  NodeId variable(const Token& name);
  NodeId call(const Token& name);
  NodeId call(const Token& name, const Function& function);
  std::vector<NodeId> arguments(const Token& name, std::string_view usage, std::size_t least, std::size_t most);
  NodeId attribute(const Token& name);
  NodeId field(std::string_view name, const Location& where);
  std::vector<int> species(const Token& of);
  std::vector<int> species_in_brackets(const Token& name);
  std::vector<int> gradient(const Token& name);
  int component_of(const std::vector<int>& species, const Token& name) const;
  NodeId laplacian(const Token& name);
  NodeId squared_gradient(const Token& name);
  NodeId product(const Token& name);
  NodeId product_of_gradients(const std::vector<int>& a, const std::vector<int>& b, const Token& name);
  NodeId norm(const Token& name);
  NodeId cross_product(const Token& name);
  NodeId sum_of_products(const std::array<NodeId, 3>& u, const std::array<NodeId, 3>& v);
  std::array<NodeId, 3> vector(const Token& of);
  std::optional<std::array<NodeId, 3>> vector_called(std::string_view name, const Location& where);
  NodeId divergence(const Token& name);
  NodeId flux(const Token& name);
  NodeId operator_symbol(Symbol symbol, const Token& name);
  std::optional<int> species_index(std::string_view name) const;
  std::vector<int> species_called(std::string_view name) const;
  void require_plain_coefficient(NodeId c, const Token& name) const;
  std::string derivative_hint(std::string_view word) const;
  NodeId white_noise(const Token& name);
  NodeId noise(const Token& name);
  double constant_argument(const Token& name, NodeId argument, const std::string& what) const;
  std::uint64_t next_stream() { return hash(label_, occurrence_++); }
  [[noreturn]] void unknown(const Token& name, bool is_function) const;
  [[noreturn]] static void gradient_alone(const Token& name);

  Graph& graph_;
  const Scope& scope_;
  const std::vector<Token> tokens_;
  const std::uint64_t label_;
  const int component_;
  std::uint64_t occurrence_ = 0;
  std::size_t position_ = 0;
  int depth_ = 0;
};

NodeId Parser::disjunction() {
  const Level level(*this);
  NodeId result = conjunction();
  while (accept("or")) result = make(Op::logical_or, result, conjunction());
  return result;
}

NodeId Parser::conjunction() {
  NodeId result = negation();
  while (accept("and")) result = make(Op::logical_and, result, negation());
  return result;
}

NodeId Parser::negation() {
  if (!accept("not")) return comparison();
  const Level level(*this);
  return make(Op::logical_not, negation());
}

NodeId Parser::comparison() {
  const auto is_comparison = [&] {
    return std::ranges::any_of(std::array{"<", "<=", ">", ">=", "==", "!="}, [&](auto sign) { return sees(sign); });
  };
  const NodeId a = sum();
  if (!is_comparison()) return a;
  const std::string_view sign = take().text;
  const NodeId b = sum();
  if (is_comparison()) expected("one comparison (write a < b and b < c)");
  if (sign == "<") return make(Op::less, a, b);
  if (sign == "<=") return make(Op::less_equal, a, b);
  if (sign == ">") return make(Op::less, b, a);
  if (sign == ">=") return make(Op::less_equal, b, a);
  const NodeId equal = make(Op::equal, a, b);
  return sign == "==" ? equal : make(Op::logical_not, equal);
}

NodeId Parser::sum() {
  NodeId result = product();
  while (true) {
    if (accept("+"))
      result = make(Op::add, result, product());
    else if (accept("-"))
      result = make(Op::subtract, result, product());
    else
      return result;
  }
}

NodeId Parser::product() {
  NodeId result = signed_power();
  while (true) {
    if (accept("*"))
      result = make(Op::multiply, result, signed_power());
    else if (accept("/"))
      result = make(Op::divide, result, signed_power());
    else
      return result;
  }
}

NodeId Parser::signed_power() {
  if (!sees("+") && !sees("-")) return power();
  const Level level(*this);
  return take().text == "-" ? make(Op::negate, signed_power()) : signed_power();
}

NodeId Parser::power() {
  const NodeId base = primary();
  if (!accept("^")) return base;
  const Level level(*this);
  return make(Op::power, base, signed_power());
}

NodeId Parser::primary() {
  if (peek().kind == Token::Kind::number) return graph_.constant(take().number);
  if (sees("(")) return parenthesis();
  if (peek().kind != Token::Kind::name || sees("and") || sees("or") || sees("not")) expected("a number, a name or '('");
  const Token& name = take();
  return sees("(") ? call(name) : variable(name);
}

NodeId Parser::parenthesis() {
  const Token& open = take();
  const NodeId result = disjunction();
  if (!accept(")")) expected("')' to close the '(' at column " + std::to_string(open.where.column));
  return result;
}

NodeId Parser::variable(const Token& name) {
  if (const auto found = scope_.names.find(name.text); found != scope_.names.end()) return found->second;
  if (component_ > 0)
    if (const auto found = scope_.names.find(component_name(name.text, component_)); found != scope_.names.end())
      return found->second;
  if (name.text == "grad") gradient_alone(name);
  if (name.text == "pi") return graph_.constant(3.14159265358979323846);
  if (name.text == "e") return graph_.constant(2.71828182845904523536);
  const auto symbol = [&](Symbol value) {
    value.where = name.where;
    return graph_.symbol(value);
  };
  if (const Symbol* built_in = built_in_symbol(name.text)) return symbol(*built_in);
  if (name.text == "H") {
    const NodeId k1 = symbol(*built_in_symbol("k1")), k2 = symbol(*built_in_symbol("k2"));
    return make(Op::multiply, graph_.constant(0.5), make(Op::add, k1, k2));
  }
  if (is_stage_field(name.text)) return field(name.text, name.where);
  unknown(name, false);
}

NodeId Parser::call(const Token& name) {
  if (name.text == "attribute") return attribute(name);
  if (name.text == "lap") return laplacian(name);
  if (name.text == "grad2") return squared_gradient(name);
  if (name.text == "dot") return product(name);
  if (name.text == "norm") return norm(name);
  if (name.text == "cross") return cross_product(name);
  if (name.text == "div") return divergence(name);
  if (name.text == "grad") gradient_alone(name);
  if (name.text == "uniform" || name.text == "normal") return white_noise(name);
  if (name.text == "noise") return noise(name);
  for (const Function& function : pure_functions())
    if (function.name == name.text) return call(name, function);
  unknown(name, true);
}

NodeId Parser::call(const Token& name, const Function& function) {
  std::vector<Term> terms;
  for (const NodeId id : arguments(name, function.usage, function.arguments, function.arguments))
    terms.push_back({&graph_, id});
  return function.build(terms).id;
}

std::vector<NodeId> Parser::arguments(const Token& name, std::string_view usage, std::size_t least, std::size_t most) {
  take();  // '('
  std::vector<NodeId> list;
  if (!sees(")")) {
    do list.push_back(disjunction());
    while (accept(","));
  }
  if (!accept(")")) expected("',' or ')' in the arguments of " + std::string(name.text));
  if (list.size() < least || list.size() > most)
    throw Error(Fault::usage,
                "expected " + std::string(usage) + ", found " + std::to_string(list.size()) +
                    (list.size() == 1 ? " argument" : " arguments"),
                name.where);
  return list;
}

NodeId Parser::attribute(const Token& name) {
  take();  // '('
  if (peek().kind != Token::Kind::name) expected("the name of a vertex attribute");
  Symbol symbol{Symbol::Kind::attribute};
  symbol.name = take().text;
  symbol.where = name.where;
  if (!accept(")")) expected("')' after the name of the attribute");
  return graph_.symbol(symbol);
}

NodeId Parser::field(std::string_view name, const Location& where) {
  Symbol field{Symbol::Kind::attribute};
  field.name = name;
  field.where = where;
  return graph_.symbol(field);
}

std::optional<int> Parser::species_index(std::string_view name) const {
  const auto found = scope_.names.find(name);
  if (found == scope_.names.end() || graph_[found->second].op != Op::symbol) return std::nullopt;
  const Symbol& symbol = graph_.symbol_of(found->second);
  return symbol.kind == Symbol::Kind::species ? std::optional(symbol.index) : std::nullopt;
}

/// One species, or the three that are the components of a vector; none for other names.
std::vector<int> Parser::species_called(std::string_view name) const {
  if (const auto index = species_index(name)) return {*index};
  std::vector<int> list;
  for (int k = 1; k <= 3; ++k)
    if (const auto index = species_index(component_name(name, k))) list.push_back(*index);
  if (list.size() != 3) list.clear();
  return list;
}

/// The numbers of the species that stands here, one or three.
std::vector<int> Parser::species(const Token& of) {
  if (peek().kind == Token::Kind::name)
    if (const std::vector<int> found = species_called(peek().text); !found.empty()) {
      take();
      return found;
    }
  const bool is_formula = peek().kind != Token::Kind::name || std::ranges::count(reserved_names(), peek().text) > 0;
  const std::string function(of.text);
  expected("the name of a species in " + function + "()" +
           (is_formula ? " (for " + function + " of a formula make a species that equals it)" : ""));
}

std::vector<int> Parser::species_in_brackets(const Token& name) {
  take();  // '('
  const std::vector<int> list = species(name);
  if (!accept(")"))
    expected("')' after the name of the species; for " + std::string(name.text) +
             "(formula) make a species that equals the formula");
  return list;
}

/// The one that a formula of this component means.
int Parser::component_of(const std::vector<int>& species, const Token& name) const {
  if (species.size() == 1) return species[0];
  if (component_ == 0)
    throw Error(Fault::usage,
                std::string(name.text) + "() of a vector is a vector; name one of its components, _1, _2 or _3",
                name.where);
  return species[static_cast<std::size_t>(component_ - 1)];
}

NodeId Parser::operator_symbol(Symbol symbol, const Token& name) {
  symbol.where = name.where;
  return graph_.symbol(symbol);
}

NodeId Parser::laplacian(const Token& name) {
  return operator_symbol({Symbol::Kind::laplacian, component_of(species_in_brackets(name), name)}, name);
}

/// Of a vector the sum over its components, as of dot(grad u, grad v).
NodeId Parser::squared_gradient(const Token& name) {
  const std::vector<int> of = species_in_brackets(name);
  return product_of_gradients(of, of, name);
}

/// `grad u` or `grad(u)` as a part of another function.
std::vector<int> Parser::gradient(const Token& name) {
  if (!sees("grad")) expected("grad of a species in " + std::string(name.text) + "()");
  const Token& grad = take();
  return sees("(") ? species_in_brackets(grad) : species(grad);
}

/// dot(grad u, grad v), or dot(u, v) of vectors.
NodeId Parser::product(const Token& name) {
  take();  // '('
  if (!sees("grad")) {
    const std::array<NodeId, 3> u = vector(name);
    if (!accept(",")) expected("',' between the vectors of dot(u, v)");
    const std::array<NodeId, 3> v = vector(name);
    if (!accept(")")) expected("')' after dot(u, v");
    return sum_of_products(u, v);
  }
  const std::vector<int> a = gradient(name);
  if (!accept(",")) expected("',' between the gradients of dot(grad u, grad v)");
  const std::vector<int> b = gradient(name);
  if (!accept(")")) expected("')' after dot(grad u, grad v");
  if (a.size() != b.size())
    throw Error(Fault::usage, "dot(grad u, grad v) takes two species or two vectors", name.where);
  return product_of_gradients(a, b, name);
}

NodeId Parser::product_of_gradients(const std::vector<int>& a, const std::vector<int>& b, const Token& name) {
  std::optional<NodeId> sum;
  for (std::size_t k = 0; k < a.size(); ++k) {
    Symbol symbol{Symbol::Kind::gradients, std::min(a[k], b[k])};
    symbol.other = std::max(a[k], b[k]);
    const NodeId product = operator_symbol(symbol, name);
    sum = sum ? make(Op::add, *sum, product) : product;
  }
  return *sum;
}

/// Those of which all components are known; fields of earlier stages are found when all stages are.
std::optional<std::array<NodeId, 3>> Parser::vector_called(std::string_view name, const Location& where) {
  std::array<NodeId, 3> u;
  for (int k = 1; k <= 3; ++k) {
    const std::string component = component_name(name, k);
    const auto found = scope_.names.find(component);
    if (found == scope_.names.end() && !is_stage_field(name)) return std::nullopt;
    u[static_cast<std::size_t>(k - 1)] = found == scope_.names.end() ? field(component, where) : found->second;
  }
  return u;
}

std::array<NodeId, 3> Parser::vector(const Token& of) {
  if (peek().kind == Token::Kind::name)
    if (const auto found = vector_called(peek().text, peek().where)) {
      take();
      return *found;
    }
  expected((of.text == "dot" ? "grad of a species or " : "") + std::string("the name of a vector in ") +
           std::string(of.text) + "(), one u of which u_1, u_2 and u_3 are known");
}

NodeId Parser::sum_of_products(const std::array<NodeId, 3>& u, const std::array<NodeId, 3>& v) {
  NodeId sum = make(Op::multiply, u[0], v[0]);
  for (std::size_t k = 1; k < 3; ++k) sum = make(Op::add, sum, make(Op::multiply, u[k], v[k]));
  return sum;
}

NodeId Parser::norm(const Token& name) {
  take();  // '('
  const std::array<NodeId, 3> u = vector(name);
  if (!accept(")")) expected("')' after norm(u");
  return make(Op::square_root, sum_of_products(u, u));
}

NodeId Parser::cross_product(const Token& name) {
  take();  // '('
  const std::array<NodeId, 3> u = vector(name);
  if (!accept(",")) expected("',' between the vectors of cross(u, v)");
  const std::array<NodeId, 3> v = vector(name);
  if (!accept(")")) expected("')' after cross(u, v");
  if (component_ == 0)
    throw Error(Fault::usage, "cross(u, v) is a vector and stands in the formulas of vectors only", name.where);
  const auto a = static_cast<std::size_t>(component_ % 3), b = (a + 1) % 3;
  return make(Op::subtract, make(Op::multiply, u[a], v[b]), make(Op::multiply, u[b], v[a]));
}

void Parser::gradient_alone(const Token& name) {
  throw Error(Fault::usage,
              "a gradient is no number: |grad u|^2 is written grad2(u), and gradients stand in dot(grad u, grad v) and "
              "div(c grad u) only",
              name.where);
}

NodeId Parser::divergence(const Token& name) {
  take();  // '('
  NodeId sum = accept("-") ? make(Op::negate, flux(name)) : flux(name);
  while (sees("+") || sees("-")) {
    const Op op = take().text == "+" ? Op::add : Op::subtract;
    sum = make(op, sum, flux(name));
  }
  if (!accept(")")) expected("')' after div(c grad u");
  return sum;
}

/// The divergence of one flux: factors of which one is a gradient.
NodeId Parser::flux(const Token& name) {
  NodeId c = graph_.constant(1);
  std::optional<int> of;
  Op op = Op::multiply;
  do {
    if (op == Op::multiply && !of && sees("grad"))
      of = component_of(gradient(name), name);
    else
      c = make(op, c, signed_power());
    op = sees("/") ? Op::divide : Op::multiply;
  } while (accept("*") || accept("/") || (!of && sees("grad")));
  if (!of) expected("a gradient in each term of div(), as in div(c grad u)");
  require_plain_coefficient(c, name);
  if (graph_.constant_value(c)) return make(Op::multiply, c, operator_symbol({Symbol::Kind::laplacian, *of}, name));
  Symbol symbol{Symbol::Kind::divergence, *of};
  symbol.other = c;
  return operator_symbol(symbol, name);
}

/// The coefficient is evaluated where no other derivatives are known.
void Parser::require_plain_coefficient(NodeId c, const Token& name) const {
  for (const NodeId id : reachable(graph_, std::array{c})) {
    if (graph_[id].op != Op::symbol) continue;
    const Symbol::Kind kind = graph_.symbol_of(id).kind;
    if (kind == Symbol::Kind::laplacian || kind == Symbol::Kind::gradients || kind == Symbol::Kind::divergence)
      throw Error(
          Fault::usage,
          "the coefficient c of div(c grad u) cannot contain lap(), grad2(), dot() or div(); make a species that "
          "equals it",
          name.where);
  }
}

/// Of words like u_x and u_xx.
std::string Parser::derivative_hint(std::string_view word) const {
  const auto end = word.rfind('_');
  if (end == std::string_view::npos || end + 1 == word.size() || !species_index(word.substr(0, end)) ||
      word.find_first_not_of("xyz", end + 1) != std::string_view::npos)
    return "";
  const std::string u(word.substr(0, end));
  return "a surface has no derivatives along x: |grad " + u + "|^2 is written grad2(" + u + "), the Laplacian lap(" +
         u + ")";
}

NodeId Parser::white_noise(const Token& name) {
  const bool is_uniform = name.text == "uniform";
  const auto in = arguments(name, is_uniform ? "uniform(lower, upper)" : "normal(mean, deviation)", 2, 2);
  Symbol symbol{is_uniform ? Symbol::Kind::uniform : Symbol::Kind::gaussian};
  symbol.stream = next_stream();
  symbol.where = name.where;
  const NodeId draw = graph_.symbol(symbol);
  const NodeId width = is_uniform ? make(Op::subtract, in[1], in[0]) : in[1];
  return make(Op::add, in[0], make(Op::multiply, width, draw));
}

NodeId Parser::noise(const Token& name) {
  const auto in = arguments(name, "noise(length) or noise(length, seed)", 1, 2);
  Symbol symbol{Symbol::Kind::noise};
  symbol.where = name.where;
  symbol.length = constant_argument(name, in[0], "the length of noise");
  if (!(symbol.length > 0)) throw Error(Fault::usage, "the length of noise must be greater than 0", name.where);
  symbol.stream = next_stream();
  if (in.size() > 1) {
    const double seed = constant_argument(name, in[1], "the seed of noise");
    if (!(seed >= 0 && seed < 1e15 && seed == std::floor(seed)))
      throw Error(Fault::usage, "the seed of noise must be a whole number from 0 to 1e15", name.where);
    symbol.stream = hash(text_hash("noise"), static_cast<std::uint64_t>(seed));
  }
  return graph_.symbol(symbol);
}

double Parser::constant_argument(const Token& name, NodeId argument, const std::string& what) const {
  const auto value = graph_.constant_value(argument);
  if (!value || !std::isfinite(*value))
    throw Error(Fault::usage, what + " must be a number or made of parameters", name.where);
  return *value;
}

void Parser::unknown(const Token& name, bool is_function) const {
  const std::string word(name.text);
  if (const auto found = scope_.not_yet.find(word); found != scope_.not_yet.end())
    throw Error(Fault::usage, "\"" + word + "\" " + found->second, name.where);
  const bool known = scope_.names.contains(word) || std::ranges::count(reserved_names(), word) > 0;
  if (known)
    throw Error(Fault::usage,
                is_function ? "\"" + word + "\" is not a function; write a * between factors"
                            : "\"" + word + "\" is a function: expected '(' after it",
                name.where);
  std::vector<std::string> names;
  if (!is_function)
    for (const auto& [text, id] : scope_.names) names.push_back(text);
  names.insert(names.end(), reserved_names().begin(), reserved_names().end());
  std::string hint = written_otherwise(word);
  if (hint.empty() && !is_function && scope_.names.contains(component_name(word, 1)))
    hint = "a vector is a number by its components, " + component_name(word, 1) + ", or as norm(" + word +
           ") and dot(" + word + ", v)";
  if (hint.empty()) hint = derivative_hint(word);
  if (hint.empty()) hint = did_you_mean(word, names);
  throw Error(Fault::usage,
              (is_function ? "unknown function \"" : "unknown name \"") + word + "\"" +
                  (hint.empty() ? "; a mesh attribute is written attribute(name)" : "; " + hint),
              name.where);
}

}  // namespace

NodeId parse_formula(Graph& graph, const Formula& formula, const Scope& scope, std::string_view label) {
  return Parser(graph, formula, scope, label).parse();
}

const std::vector<std::string>& reserved_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list = {"and", "or", "not"};
    for (const Word& word : words())
      if (std::ranges::count(list, word.name()) == 0) list.emplace_back(word.name());
    return list;
  }();
  return names;
}

}  // namespace pelage
